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

/// Moves the surface by `out` along its normals for the outer side and by `in` against them for the inner side, and
/// joins both by walls along all loops. Every edge of the solid has two faces, in opposite directions.
/// @param normals (V, 3) unit @param out (V) @param in (V)
/// @throws InputError a face would turn over, as the surface bends more tightly there (elements: faces)
Solid thicken(const Vertices& vertices, const Triangles& triangles, const Vertices& normals, const VectorXd& out,
              const VectorXd& in);

/// Faces that point away from their former normal, or have no area any more, when vertices move.
std::vector<Index> overturned_faces(const Vertices& before, const Vertices& after, const Triangles& triangles);

}  // namespace koebe
