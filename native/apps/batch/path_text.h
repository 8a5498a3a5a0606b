// Paths as text for libuv and reports, and libuv's errors.
#pragma once

#include <filesystem>
#include <string>

namespace koebe::batch {

/// The path in UTF-8 on Windows, in its own bytes elsewhere.
std::string utf8(const std::filesystem::path& path);
/// utf8 with "/" between folders on every system.
std::string generic_utf8(const std::filesystem::path& path);
std::filesystem::path path_of(const std::string& text);

/// @param what "cannot start blender"
/// @throws FileError "WHAT (reason)"
[[noreturn]] void fail(const std::string& what, int libuv_status);

}  // namespace koebe::batch
