// What the C++ library has no word for: files by their numbers, on every system.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string_view>

namespace koebe::io {

/// A new file to write, closed in child processes. @returns -1 and errno; EEXIST where something has that name
int open_new(const std::filesystem::path& path);

/// What is there already, a pipe or a device, to write to. @returns -1 and errno
int open_device(const std::filesystem::path& path);

/// A file to read, byte for byte. @returns nullptr and errno
std::FILE* open_to_read(const std::filesystem::path& path);

/// All of it. @returns whether it could be written, else errno says why not
bool write_all(int descriptor, std::string_view bytes);

/// @returns whether what was written has arrived, else errno says why not
bool close_written(int descriptor);

/// Asks for no memory, so that it serves where there is none.
void remove_now(const std::filesystem::path& path) noexcept;

/// Whether this user may write to what is there. In a folder: may make files. @returns false and errno
bool may_write(const std::filesystem::path& path);

/// Whether two paths name one thing that is there, through symbolic and hard links. The null device, which keeps
/// nothing, is never the same as anything.
bool is_same(const std::filesystem::path& a, const std::filesystem::path& b);

/// The same for an open file.
bool is_open_as(int descriptor, const std::filesystem::path& path);

/// The number of this process.
int process_number();

}  // namespace koebe::io
