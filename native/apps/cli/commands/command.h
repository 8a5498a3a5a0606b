// The koebe command: parses, runs one sub-command, and turns errors into one line and an exit code.
#pragma once

#include "core/api.h"

namespace koebe::cli {

/// @param argc, argv as main() has them
/// @returns the exit code
KOEBE_API int command(int argc, char** argv);

}  // namespace koebe::cli
