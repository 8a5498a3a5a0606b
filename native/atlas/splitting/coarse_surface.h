// A surface with fewer faces.
#pragma once

#include "core/api.h"
#include "execution/execution.h"
#include "part_maps/part_mesh.h"

#include <vector>

namespace koebe {

/// A vertex with more faces is a hub: it goes nowhere, its faces are not looked at, and trees of boxes do not tell them
/// apart.
constexpr int hub_faces = 500;

struct CoarseSurface {
    Vertices vertices;
    Triangles triangles;
    std::vector<Index> vertex;     ///< for each coarse vertex the fine vertex that it is
    std::vector<Index> vertex_at;  ///< (V) for each fine vertex the coarse vertex that it was moved to
};

/// Collapses edges (OpenMesh), those first that move vertices least, until `faces` are left or no edge can go. Never
/// turns a face over. Keeps the topology and the number of loops.
/// @param triangles (F, 3) manifold and oriented @param image (V) mirror images, -1 for none: an edge and its image go
/// together; empty: there is no mirror
/// @param border (V) 1 on a part of the boundary that stays: its edges become one only along it, its ends stay, and no
/// edge goes across from one of its vertices to another; empty: there is none
KOEBE_API CoarseSurface coarse_surface(const Vertices& vertices, const Triangles& triangles, Index faces,
                                       const std::vector<Index>& image, ExecutionContext& context,
                                       const std::vector<char>& border = {});

}  // namespace koebe
