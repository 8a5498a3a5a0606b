// A file that is whole or absent, and of which a process that is killed leaves nothing beside it.
#pragma once

#include <filesystem>
#include <string_view>

namespace koebe::batch {

/// Writes in a folder of a claim, which the next run removes, and renames. AtomicFile alone writes beside the target,
/// where nobody would remove what is left.
/// @param work on the target's file system
/// @throws FileError
void write_whole(const std::filesystem::path& work, const std::filesystem::path& target, std::string_view text);

/// @throws FileError
void move_whole(const std::filesystem::path& source, const std::filesystem::path& target);

}  // namespace koebe::batch
