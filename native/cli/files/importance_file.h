// Reads the file of --importance.
#pragma once

#include <string>
#include <vector>

namespace koebe::cli {

/// Numbers from 0 to 1, one for each vertex in the mesh's order, separated by spaces, commas or ends of lines.
/// @throws FileError, InputError a word that is not such a number
std::vector<double> read_importance(const std::string& path);

}  // namespace koebe::cli
