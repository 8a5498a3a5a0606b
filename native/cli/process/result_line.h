// The one line on standard output.
#pragma once

#include "core/warning.h"

#include <string>
#include <vector>

namespace koebe::cli {

/// A text without line ends and other control characters, and in UTF-8: file names may have any bytes.
std::string one_line(std::string text);

/// The end of a result line: how many warnings there are, and the start of the first. Empty if there is none.
std::string warning_count(const std::vector<Warning>& warnings);

/// All of them on standard error, for people only: scripts find them in the JSON.
void show_warnings(const std::vector<Warning>& warnings);

}  // namespace koebe::cli
