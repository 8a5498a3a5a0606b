// Standard output that is closed, full or a broken pipe is an error like that of any other file.
#pragma once

#include <string>
#include <string_view>

namespace koebe::cli {

constexpr int standard_output = 1;  // as every system numbers it

/// Whether a person reads standard error as it is written, by a terminal that obeys what erases a line.
bool is_error_shown();

/// Fills the places of standard streams that are closed, so that no file opened later takes them and gets what is
/// meant for people. Writing to a standard output that was closed stays an error.
void keep_standard_streams();

/// What can be known to fail, asked before a long computation.
/// @throws FileError standard output is closed
void require_standard_output();

/// Writes text to standard output, now.
/// @param done what is so all the same, added to the error
/// @throws FileError
void print(std::string_view text, const std::string& done = {});

}  // namespace koebe::cli
