// The programs that a batch starts.
#pragma once

#include <string>

namespace koebe::batch {

/// The file of this command itself.
/// @throws FileError the system does not tell
std::string own_program();

/// How many processes can run at once.
unsigned core_count();

/// The add-on's batch.py: the one given, or that of the checkout which this command was built in.
/// @throws FileError there is none
std::string blender_script(const std::string& given);

}  // namespace koebe::batch
