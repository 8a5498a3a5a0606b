// The same surface on more faces, each one's corners still known.
#pragma once

#include "core/types.h"

#include <array>
#include <vector>

namespace koebe {

struct FinerFaces {
    Vertices vertices;                          ///< the input's come first
    Triangles triangles;                        ///< inside the input's faces, oriented as they are
    std::vector<Index> input_face;              ///< of each triangle
    std::vector<std::array<Index, 3>> corners;  ///< of each input face: triangle times 3 plus its corner
};

/// Every face cut in four at the middles of its edges, until there are enough, but at most `most_levels` times.
FinerFaces finer_faces(const Vertices& vertices, const Triangles& triangles, Index enough, int most_levels);

}  // namespace koebe
