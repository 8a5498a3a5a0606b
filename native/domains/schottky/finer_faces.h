// Splits the faces of a surface and keeps track of the input's corners.
#pragma once

#include "core/types.h"

#include <array>
#include <vector>

namespace koebe {

struct FinerFaces {
    Vertices vertices;                          ///< the input's come first
    Triangles triangles;                        ///< inside the input's faces, with their orientation
    std::vector<Index> input_face;              ///< the input's face that holds each triangle
    std::vector<std::array<Index, 3>> corners;  ///< of each input face: triangle times 3 plus its corner
};

/// Cuts every face in four at the middles of its edges, until there are enough, at most `most_levels` times.
FinerFaces finer_faces(const Vertices& vertices, const Triangles& triangles, Index enough, int most_levels);

}  // namespace koebe
