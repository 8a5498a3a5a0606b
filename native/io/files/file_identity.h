// Tells whether paths name the same file.
#pragma once

#include <filesystem>

namespace koebe::io {

/// The file at the end of a chain of symbolic links, whether it exists or not.
/// @throws FileError the links form a circle
std::filesystem::path followed(const std::filesystem::path& path);

std::filesystem::path folder_of(const std::filesystem::path& path);

/// Whether the path is neither a regular file nor a folder, but exists.
bool is_pipe_or_device(const std::filesystem::path& path);

/// Whether two paths name one file, through symbolic and hard links, by device and inode. Paths that do not exist yet
/// are compared by folder and name, with the case of letters ignored where the file system does so. The null device,
/// which keeps nothing, equals no path.
/// @throws FileError links form a circle
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace koebe::io
