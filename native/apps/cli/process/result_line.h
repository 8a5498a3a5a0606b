// The one line on standard output.
#pragma once

#include "core/warning.h"

#include <string>
#include <vector>

namespace koebe::cli {

/// The text in UTF-8 without line ends and other control characters: file names may hold any bytes.
std::string one_line(std::string text);

/// The number of warnings and the start of the first; empty without warnings.
std::string warning_count(const std::vector<Warning>& warnings);

/// The end of a result line: the time, whether the map is not converged, and warning_count.
std::string last_words(double seconds, bool converged, const std::vector<Warning>& warnings);

/// Prints all warnings on standard error, for people only: scripts find them in the JSON.
void show_warnings(const std::vector<Warning>& warnings);

}  // namespace koebe::cli
