// The model in a GLB file, read by tinygltf, and the elements of its accessors.
#pragma once

#include <string>
#include <string_view>

#define TINYGLTF_NO_FS
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#include <tiny_gltf.h>

namespace koebe::io {

/// Reads meshes, accessors and buffers. Images are not decoded, other files are not read.
/// @throws InputError damaged; geometry is compressed, or in another file
tinygltf::Model read_gltf_model(std::string_view glb);

/// Bytes of an element: components times their size.
std::size_t accessor_element_bytes(const tinygltf::Accessor& accessor);

/// The elements of an accessor without gaps, sparse ones put in.
/// @param count how many there must be; -1: as many as there are, in a buffer or sparse
/// @throws InputError the accessor does not exist, has another count, or leaves its buffer
std::string accessor_elements(const tinygltf::Model& model, int accessor, std::ptrdiff_t count = -1);

}  // namespace koebe::io
