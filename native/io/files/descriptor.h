// File operations that the C++ library lacks, by file numbers, on every system.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string_view>

namespace koebe::io {

/// Opens a new file to write, closed in child processes. @returns -1 and errno; EEXIST if the name exists
int open_new(const std::filesystem::path& path);

/// Opens an existing pipe or device to write. @returns -1 and errno
int open_device(const std::filesystem::path& path);

/// Opens a file to read, byte for byte. @returns nullptr and errno
std::FILE* open_to_read(const std::filesystem::path& path);

/// Writes all bytes. @returns false and errno if it failed
bool write_all(int descriptor, std::string_view bytes);

/// Closes a file. @returns false and errno if its bytes did not arrive
bool close_written(int descriptor);

/// Removes a file. Allocates no memory, so that it works without any.
void remove_now(const std::filesystem::path& path) noexcept;

/// Whether this user may write to the file, or make files in the folder. @returns false and errno
bool may_write(const std::filesystem::path& path);

/// Whether two paths name the same existing file, through symbolic and hard links. The null device, which keeps
/// nothing, equals no path.
bool is_same(const std::filesystem::path& a, const std::filesystem::path& b);

/// Whether a path names this open file.
bool is_open_as(int descriptor, const std::filesystem::path& path);

/// The number of this process.
int process_number();

}  // namespace koebe::io
