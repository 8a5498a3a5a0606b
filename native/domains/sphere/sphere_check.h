// Checks the promises of a map to the sphere.
#pragma once

#include "sphere/spherical_points.h"

#include <vector>

namespace koebe {

/// Smaller lengths on the unit sphere are lost in the rounding of unit vectors and of the solver.
inline constexpr double sphere_resolution = 1e-12;

struct SphereFaults {
    std::vector<Index> flipped;           ///< faces that are not upright
    std::vector<Index> below_resolution;  ///< flipped faces whose longest edge is under sphere_resolution
    std::vector<int> holes;               ///< loops that do not run once round their hole
    std::vector<int> lost_holes;          ///< loops shorter than sphere_resolution, which are not checked
    bool covering = false;                ///< the areas of faces and holes do not add up to 4 pi

    bool any() const { return flipped.size() > below_resolution.size() || !holes.empty() || covering; }
};

/// Checks that the faces, triangles with the shorter arcs as sides, and the holes cover each point of the sphere once.
/// Let all faces be upright (exact arithmetic), and all loops simple round their hole. Then the map of the closed
/// surface, with its holes filled, is a covering except for branch points at vertices. Its areas add up to 4 pi times
/// its number of sheets. With one sheet there are no branch points.
/// @param triangles in one orientation @param points (V, 3) unit vectors @param caps of the loops
SphereFaults find_sphere_faults(const Triangles& triangles, const std::vector<VertexLoop>& loops,
                                const Vertices& points, const std::vector<Cap>& caps);

/// Whether a face is upright, in exact arithmetic.
bool upright_on_sphere(const Triangles& triangles, const Vertices& points, Index face);

double longest_edge_on_sphere(const Triangles& triangles, const Vertices& points, Index face);

}  // namespace koebe
