// What files are, whatever they are called.
#pragma once

#include <filesystem>

namespace koebe::io {

/// The file that a chain of symbolic links leads to, be it there or not.
/// @throws FileError the links form a circle
std::filesystem::path followed(const std::filesystem::path& path);

std::filesystem::path folder_of(const std::filesystem::path& path);

/// Whether something is there that is neither a regular file nor a folder.
bool is_pipe_or_device(const std::filesystem::path& path);

/// Whether two paths name one file, through symbolic and hard links: by device and inode. Names of which nothing is
/// there yet, by their folders and names, where the file system does not tell large letters from small ones by those.
/// The null device, which keeps nothing, is never the same.
/// @throws FileError links form a circle
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace koebe::io
