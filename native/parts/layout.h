// The parts of a mesh, flat and packed into the unit square.
#pragma once

#include "execution/execution.h"
#include "parts/parts.h"

#include <vector>

namespace koebe {

/// The corners of a face are in the order in which it was mapped: some faces were turned.
struct PartsLayout {
    Vertices vertices;        ///< the input's vertices, scaled so that all areas sum to 1
    Triangles triangles;      ///< (F, 3) faces of the input, turned to one orientation in each piece
    PlanarPoints uv;          ///< (3F, 2) in [0, 1]^2
    std::vector<Index> part;  ///< (F); -1: a face in no part: it is degenerate, or doubles another face
    std::vector<PartReport> parts;
    std::vector<Index> reoriented;  ///< faces that were turned
    Index overlaps = 0;             ///< number of parts whose boundary crosses itself
    std::vector<Index> crossing;    ///< faces of these parts
    double slit_length = 0.0, dart_length = 0.0;
    Index darts = 0;
    int handles_cut = 0;
    double even = 0.0;            ///< the E of all parts, except
    std::vector<Index> not_even;  ///< these faces: their parts stayed conformal
    double maps = 0.0;            ///< number of faces mapped, over the faces of the mesh
};

/// @throws as parts_of
PartsLayout parts_layout(const Vertices& vertices, const Triangles& triangles, const PartsOptions& options,
                         ExecutionContext& context);

}  // namespace koebe
