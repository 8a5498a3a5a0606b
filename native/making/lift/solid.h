// A closed solid of a thickness from a surface with loops.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

struct Solid {
    Vertices vertices;
    Triangles triangles;
    std::vector<Index> patch;  ///< (F) 0: the outer side, 1: the inner side, 2: walls along the loops
};

/// Joins two sheets with the same loops to a solid. Every edge of the solid has two faces, in opposite directions.
/// Where a wall of the outer side ends at a loop, its edge has one vertex of the inner side below it.
/// @param source (V) vertex of the inner side below each vertex of the outer side
Solid closed_solid(const Vertices& outside, const Triangles& outer_faces, const Vertices& inside,
                   const Triangles& inner_faces, const std::vector<Index>& source);

/// The vertices moved along the normals, and the faces of `triangles` checked.
/// @param normals (V, 3) unit @param by (V)
/// @throws InputError a face would turn over, because the surface bends too tightly there (elements: faces)
Vertices moved_along(const Vertices& vertices, const Vertices& normals, const VectorXd& by, const Triangles& triangles);

}  // namespace koebe
