// Small text files that an option names.
#pragma once

#include <string>

namespace koebe::cli {

/// The text of a file, with spaces for commas.
/// @throws FileError it cannot be read
std::string read_words(const std::string& path);

}  // namespace koebe::cli
