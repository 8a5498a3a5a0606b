// Reads files with a weight for each vertex.
#pragma once

#include <string>
#include <vector>

namespace koebe::cli {

/// Numbers from 0 to 1, one for each vertex in the mesh's order, separated by spaces, commas or ends of lines.
/// @param name of such a number, with its article, for messages
/// @throws FileError, InputError a word that is not such a number
std::vector<double> read_weights(const std::string& path, const std::string& name);

}  // namespace koebe::cli
