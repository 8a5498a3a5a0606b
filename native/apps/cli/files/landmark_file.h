// Reads the file of --landmarks.
#pragma once

#include "surface/surface_point.h"

#include <string>
#include <vector>

namespace koebe::cli {

/// The points of all lines, on A and on B.
struct NamedLandmarks {
    std::vector<NamedPoint> on_a, on_b;
};

/// Each line is a landmark: two vertices, counted from 0, or x y z on A and x y z on B, separated by blanks, tabs or
/// commas. Text after a # is a comment.
/// @throws FileError it cannot be read; InputError a line that is not a landmark (its number)
NamedLandmarks read_landmarks(const std::string& path);

}  // namespace koebe::cli
