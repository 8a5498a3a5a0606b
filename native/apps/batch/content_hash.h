// Hashes the contents of files.
#pragma once

#include <filesystem>
#include <string>

namespace koebe::batch {

/// SHA-256 in hexadecimal digits, as `sha256sum` prints it.
/// @throws FileError the file cannot be read
std::string sha256_of_file(const std::filesystem::path& path);

std::string sha256_of_text(const std::string& text);

}  // namespace koebe::batch
