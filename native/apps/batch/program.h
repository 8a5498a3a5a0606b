// The programs that a batch starts.
#pragma once

#include <string>

namespace koebe::batch {

/// The path of this command itself.
/// @throws FileError the system does not tell it
std::string own_program();

/// The number of processes that can run at once.
unsigned core_count();

/// The path of the add-on's batch.py: the given one, or the one of the checkout in which this command was built.
/// @throws FileError it does not exist
std::string blender_script(const std::string& given);

}  // namespace koebe::batch
