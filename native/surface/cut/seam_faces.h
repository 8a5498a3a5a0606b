// Faces joined over their edges, where any number of faces may meet at an edge.
#pragma once

#include "cut/seamed_mesh.h"

#include <array>
#include <utility>
#include <vector>

namespace koebe {

struct Seams {
    SeamedMesh mesh;
    std::vector<std::pair<Index, Index>> crowded;   ///< edges of three or more faces
    std::vector<std::pair<Index, Index>> disagree;  ///< edges across which the two sides cannot agree
    std::vector<Index> bow_ties;                    ///< vertices with fans that share no edge
};

/// Joins faces over all edges with two faces, as far as these can be oriented alike.
/// @param faces of the input to take, ascending, each with three different vertices, no two with the same three
/// @param polygon (F) or empty, as in OpenOptions @param seams edges that stay open, as there
Seams seam_faces(const Vertices& vertices, const Triangles& triangles, const std::vector<Index>& faces,
                 const std::vector<Index>& polygon, const std::vector<std::array<Index, 2>>& seams);

}  // namespace koebe
