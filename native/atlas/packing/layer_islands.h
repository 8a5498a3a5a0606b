// The islands of a UV layer as they are.
#pragma once

#include "core/types.h"
#include "packing/packing.h"

#include <vector>

namespace koebe {

/// The vertices of the UV layer: corners of one vertex of the mesh at one place, as stored.
struct LayerVertices {
    Triangles faces;      ///< (F, 3) of these vertices
    PlanarPoints points;  ///< (V', 2) as given, in a unit in which no number is over 1
    double unit = 1.0;    ///< its length in the UVs
};

/// @param uv (3F, 2) of the corners
LayerVertices layer_vertices(const Triangles& triangles, const PlanarPoints& uv);

/// (F) islands, numbered by their first faces. @param polygon (F) faces of one polygon are in one island; or empty
std::vector<Index> islands_of(const LayerVertices& layer, const std::vector<Index>& polygon, Index& count);

/// An island by itself: its lower left corner lies at 0.
struct PackedPiece {
    std::vector<Index> faces, vertices;  ///< of the layer
    PlanarPoints points;
    bool is_mirrored = false;
    bool overlaps = false;
    bool is_locked = false;
    double area = 0.0;  ///< of its faces, each counted as positive
    Outline outline = {};
};

/// @param faces of the island
PackedPiece island_alone(const LayerVertices& layer, std::vector<Index> faces);

}  // namespace koebe
