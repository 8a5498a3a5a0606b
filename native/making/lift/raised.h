// A relief: faces of a sheet moved up, with walls around.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

struct RaisedSheet {
    Triangles triangles;        ///< the sheet's faces in their order, then two for each edge of a wall
    std::vector<Complex> uv;    ///< (3F); a wall has no area in the UVs
    std::vector<Index> patch;   ///< (F) 0: the ground, 1: raised, 2: walls
    std::vector<Index> source;  ///< (V) vertex of the sheet; the sheet's own come first
    VectorXd height;            ///< (V) 0 on the ground
};

/// Doubles the vertices between raised faces and the ground: one stays on the ground, and one is raised. Walls join the
/// two. Every edge keeps two faces, but for a wall's edges where it ends at a loop.
/// @param uv (3F) of corners @param up (F) whether a face is raised
RaisedSheet raise_faces(const Triangles& triangles, const std::vector<Complex>& uv, const std::vector<Index>& up,
                        Index vertex_count, double height);

}  // namespace koebe
