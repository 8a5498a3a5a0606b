// Small text files named by an option.
#pragma once

#include <string>

namespace koebe::cli {

/// The text of a file.
/// @throws FileError it cannot be read
std::string read_text(const std::string& path);

/// The text of a file, with commas replaced by spaces.
/// @throws FileError it cannot be read
std::string read_words(const std::string& path);

}  // namespace koebe::cli
