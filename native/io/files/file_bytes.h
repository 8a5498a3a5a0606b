// The bytes of a file.
#pragma once

#include <filesystem>
#include <string>

namespace koebe::io {

/// Reads a file or a pipe to its end.
/// @throws FileError it cannot be read, or is a device
std::string read_bytes(const std::filesystem::path& path);

}  // namespace koebe::io
