// Paths as the text that libuv and reports have, and the errors of libuv.
#pragma once

#include <filesystem>
#include <string>

namespace koebe::batch {

/// UTF-8 on Windows, the bytes of the name elsewhere.
std::string utf8(const std::filesystem::path& path);
/// The same with "/" between folders on every system.
std::string generic_utf8(const std::filesystem::path& path);
std::filesystem::path path_of(const std::string& text);

/// @param what "cannot start blender"
/// @throws FileError "WHAT (reason)"
[[noreturn]] void fail(const std::string& what, int libuv_status);

}  // namespace koebe::batch
