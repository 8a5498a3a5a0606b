// The parts of a glTF file's materials that count on texture coordinates.
#pragma once

#include "core/warning.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace koebe::io {

/// Primitives by the places of their mesh and in it.
using GltfPlaces = std::set<std::pair<std::size_t, std::size_t>>;

/// The set of UVs along which the tangents of a primitive run: that of its material's normal texture (glTF 2.0, section
/// 3.7.2.1).
int tangent_set(nlohmann::ordered_json& file, const nlohmann::ordered_json& primitive);

/// Takes KHR_texture_transform off the textures that lie in a set of UVs, if only these primitives have the material
/// and nothing moves the transform. Else a texture would show a part of itself on the new UVs.
/// @return warnings about the materials, changed or not: kind replaced_uvs
std::vector<Warning> take_transforms_off(nlohmann::ordered_json& file, const GltfPlaces& primitives, int set);

}  // namespace koebe::io
