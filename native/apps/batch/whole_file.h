// Writes a file completely or not at all; a killed process leaves no other file beside it.
#pragma once

#include <filesystem>
#include <string_view>

namespace koebe::batch {

/// Writes in a claim's folder, which the next run removes, and renames. AtomicFile writes beside the target, where no
/// run would remove its temporary file.
/// @param work on the target's file system
/// @throws FileError
void write_whole(const std::filesystem::path& work, const std::filesystem::path& target, std::string_view text);

/// @throws FileError
void move_whole(const std::filesystem::path& source, const std::filesystem::path& target);

}  // namespace koebe::batch
