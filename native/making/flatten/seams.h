// Where flat parts belong together: the two sides of every cut.
#pragma once

#include "core/types.h"
#include "flat/flat_part.h"

#include <cstddef>
#include <vector>

namespace koebe {

/// A side of a seam, along the rim of a flat part.
struct SeamSide {
    std::size_t part = 0;
    std::vector<Index> path;   ///< vertices of the part; on all sides the same vertices of the surface, in order
    bool inside_left = false;  ///< whether the part is on the left of the path
};

struct Seam {
    std::vector<SeamSide> sides;
    bool closed = false;  ///< the path ends with its first vertex
};

/// Finds the edges of rims that lie in the same place, and joins them to paths. A path ends where its sides part. The
/// two legs of a dart are the sides of a seam, and so are the two sides of a slit.
/// @param vertices (V, 3) of the surface; vertices in one place count as one
std::vector<Seam> find_seams(const std::vector<FlatPart>& parts, const Vertices& vertices);

}  // namespace koebe
