// Faces divided at vertices that lie on their edges (T-junctions), so that neighbours share whole edges.
#pragma once

#include "core/types.h"

#include <array>
#include <vector>

namespace koebe {

/// A vertex that divides an edge of a face.
struct DividedEdge {
    Index face, from, to, middle;
    double share;  ///< of the edge, from its beginning to the middle
};

/// The first F rows are the faces, or one piece of each. The other pieces follow.
struct DividedFaces {
    Triangles triangles;         ///< (F', 3) with the vertices and the orientation of the faces
    std::vector<Index> polygon;  ///< (F') pieces of a face, or of its polygon, have one number; empty: as given
    std::vector<Index> face;     ///< (F') the face of each piece; empty: no face is divided
    std::vector<DividedEdge> edges;
};

/// Divides faces along cracks without width: from a vertex where two boundary edges leave in one direction, the longer
/// one is divided at the end of the shorter one, and so on along the crack.
/// @param vertices (V, 3) @param triangles (F, 3) @param polygon (F) faces with the same number are one polygon, or
/// empty @param kept edges that are not divided, as pairs of vertices
DividedFaces divided_faces(const Vertices& vertices, const Triangles& triangles, const std::vector<Index>& polygon,
                           const std::vector<std::array<Index, 2>>& kept);

}  // namespace koebe
