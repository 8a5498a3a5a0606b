// The file of --landmarks.
#pragma once

#include "transfer/surface_point.h"

#include <string>
#include <vector>

namespace koebe::cli {

/// What a line names: a point of A, and one of B.
struct NamedLandmarks {
    std::vector<NamedPoint> on_a, on_b;
};

/// A line a landmark: two vertices, counted from 0, or x y z on A and x y z on B, apart by blanks, tabs or commas. What
/// follows a # is a comment.
/// @throws FileError it cannot be read; InputError a line that is something else (its number)
NamedLandmarks read_landmarks(const std::string& path);

}  // namespace koebe::cli
