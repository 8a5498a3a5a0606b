// Writes an error as one line for people and scripts.
#pragma once

#include "core/errors.h"

#include <string>

namespace koebe::cli {

/// "NAME(KIND): reason [first elements …]" without a line end; elements are counted from 0.
std::string error_line(const KoebeError& error);
/// "NAME: reason", for errors that are not the library's own.
std::string error_line(const std::string& name, const std::string& reason);

}  // namespace koebe::cli
