// Draws a circle domain.
#pragma once

#include "io/polygon_mesh.h"
#include "opened/cut_uniformize.h"
#include "pipeline/result.h"

#include <string>

namespace koebe {

/// From this many faces on, the wireframe is left out: it would be black, and its file megabytes large.
inline constexpr Index wireframe_face_limit = 50000;  // faces

/// Draws the unit disk with the loops' circles and, up to wireframe_face_limit faces, the edges of the mesh, thinner
/// where the map shrinks. The imaginary axis points up. Vertices off their loop's circle are marked.
/// @param mesh the polygons whose vertices are at result.uv
std::string to_svg(const UniformizeResult& result, const PolygonMesh& mesh);

/// Draws the unit square with the pieces of a cut surface: their circles and, as above, their edges.
/// @param mesh the polygons @param corner_uvs (C, 2) of their corners
std::string to_svg(const CutUniformizeResult& result, const PolygonMesh& mesh, const PlanarPoints& corner_uvs);

}  // namespace koebe
