// Bends a mesh over a surface: it is laid on a flat domain, and its heights go along the normals.
#pragma once

#include "lift/flat_sheet.h"
#include "lift/pattern_place.h"

#include <vector>

namespace koebe {

struct BentMesh {
    Vertices vertices;
    Triangles triangles;
    std::vector<Complex> uv;      ///< (3F) where the corners lie in the domain; a copy is in one piece, also over a cut
    std::vector<Index> original;  ///< (F) face of the mesh
    double size = 0.0;            ///< as used
    Index left_out = 0;           ///< connected parts that do not fit the domain
    std::vector<Index> left_at{};  ///< faces of the surface where such parts lie, ascending
    Index upside_down = 0;         ///< faces without a positive area in the UVs as stored: walls and undersides
};

/// x and y of the mesh are flat coordinates: their box is placed by placed_frame, and copies side by side take all of
/// their share of a period. z is a length along the surface's normal, at the scale at which the mesh's width becomes
/// `size`: a cube stays about a cube. Only vertices move, so an edge is straight in space. A connected part is left out
/// with its copy if a vertex lies outside the domain, or a face lies over the domain's border.
/// @param mesh (V, 3) @param triangles (F, 3) @param heights factor of z
/// @throws InputError as placed_frame; the mesh has no width or no height in x and y; more than four million faces
BentMesh bent_mesh(const FlatSheet& sheet, const Vertices& mesh, const Triangles& triangles, const PatternPlace& place,
                   double heights);

}  // namespace koebe
