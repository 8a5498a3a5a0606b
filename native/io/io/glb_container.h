// The container of a GLB file: a header and chunks, the first of JSON, the second of binary data.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>

namespace koebe::io {

/// A GLB file in its parts (glTF 2.0 specification, section 4.4).
struct GlbContainer {
    nlohmann::ordered_json json;  ///< keys in the file's order
    std::string_view binary;      ///< of the file's bytes; with padding; empty: there is none
    std::string_view rest;        ///< all further chunks, with their headers
};

/// @param bytes stay in place as long as the container is used
/// @throws InputError no GLB file of version 2, or damaged
GlbContainer read_glb(std::string_view bytes);

/// The bytes of a GLB file. @param more binary data behind container.binary
/// @throws InputError over 4 GiB
std::string glb_bytes(const GlbContainer& container, std::string_view more);

}  // namespace koebe::io
