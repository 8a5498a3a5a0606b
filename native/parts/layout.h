// The parts of a mesh, flat and packed into the unit square.
#pragma once

#include "execution/execution.h"
#include "parts/parts.h"

#include <vector>

namespace koebe {

/// Corners by the orientation in which the faces are mapped.
struct PartsLayout {
    Vertices vertices;        ///< of the input, in a unit in which all areas sum to 1
    Triangles triangles;      ///< (F, 3) of the input's vertices, turned to one orientation in each piece
    PlanarPoints uv;          ///< (3F, 2) in [0, 1]^2
    std::vector<Index> part;  ///< (F); -1: in no part, degenerate or the double of another
    std::vector<PartReport> parts;
    std::vector<Index> reoriented;  ///< faces that were turned
    Index overlaps = 0;             ///< parts whose boundary crosses itself,
    std::vector<Index> crossing;    ///< and their faces
    double slit_length = 0.0, dart_length = 0.0;
    Index darts = 0;
    int handles_cut = 0;
    double even = 0.0;            ///< as the parts were made,
    std::vector<Index> not_even;  ///< but for these faces
    double maps = 0.0;            ///< faces mapped, in faces of the mesh
};

/// @throws as parts_of
PartsLayout parts_layout(const Vertices& vertices, const Triangles& triangles, const PartsOptions& options,
                         ExecutionContext& context);

}  // namespace koebe
