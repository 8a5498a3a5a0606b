// Treats a standard output that is closed, full or a broken pipe like any other file that fails.
#pragma once

#include <string>
#include <string_view>

namespace koebe::cli {

constexpr int standard_output = 1;  // on every system

/// Whether a person reads standard error live, on a terminal that can erase a line.
bool is_error_shown();

/// Opens closed standard streams on the null device, so that no file opened later takes their number and gets text
/// meant for people. Writing to a standard output that was closed is still an error.
void keep_standard_streams();

/// Checks before a long computation what can already fail.
/// @throws FileError standard output is closed
void require_standard_output();

/// Writes text to standard output, at once.
/// @param done what is done nevertheless, added to the error
/// @throws FileError
void print(std::string_view text, const std::string& done = {});

}  // namespace koebe::cli
