// Grids of triangles, and parts that are whole surfaces.
#pragma once

#include "flat/flat_part.h"
#include "mesh/topology.h"

#include <numeric>

namespace koebe::test {

/// The triangles of a grid of squares, row by row. Each square is cut from its lower left to its upper right.
/// @param at (column, row) the number of a vertex
template <typename At>
Triangles grid(int columns, int rows, const At& at)
{
    Triangles triangles(2 * columns * rows, 3);
    Index f = 0;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            triangles.row(f++) << at(i, j), at(i + 1, j), at(i + 1, j + 1);
            triangles.row(f++) << at(i, j), at(i + 1, j + 1), at(i, j + 1);
        }
    return triangles;
}

/// All faces as one part, without vertices and points yet.
inline FlatPart part_of(const Triangles& triangles)
{
    FlatPart part;
    part.surface = require_bordered_genus_zero(triangles, triangles.maxCoeff() + 1);
    part.faces.resize(static_cast<std::size_t>(triangles.rows()));
    part.original.resize(static_cast<std::size_t>(part.surface.vertex_count));
    std::iota(part.faces.begin(), part.faces.end(), 0);
    std::iota(part.original.begin(), part.original.end(), 0);
    part.held.assign(part.original.size(), 0);
    return part;
}

}  // namespace koebe::test
