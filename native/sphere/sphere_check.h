// What a map to the sphere promises, and whether it keeps it.
#pragma once

#include "sphere/spherical_points.h"

#include <vector>

namespace koebe {

/// Lengths on the unit sphere: what is smaller is lost in the rounding of unit vectors and of the solver.
inline constexpr double sphere_resolution = 1e-12;

struct SphereFaults {
    std::vector<Index> flipped;           ///< faces that are not upright
    std::vector<Index> below_resolution;  ///< those of them whose longest edge is under sphere_resolution
    std::vector<int> holes;               ///< loops that are not simple round their hole
    std::vector<int> lost_holes;          ///< loops shorter than sphere_resolution: nothing is told of them
    bool covering = false;                ///< the areas of faces and holes do not sum up to 4 pi

    bool any() const { return flipped.size() > below_resolution.size() || !holes.empty() || covering; }
};

/// Whether the images of the faces, triangles with the shorter arcs as sides, cover each point of the sphere once with
/// the holes. Where all faces are upright (exact arithmetic) and all loops simple round their hole, the map of the
/// closed surface, its holes filled, is a covering but for branch points at vertices; the sum of all areas is 4 pi
/// times its number of sheets. One sheet has no branch points.
/// @param triangles in one orientation @param points (V, 3) unit vectors @param caps of the loops
SphereFaults find_sphere_faults(const Triangles& triangles, const std::vector<VertexLoop>& loops,
                                const Vertices& points, const std::vector<Cap>& caps);

/// Whether a face is upright: exact.
bool upright_on_sphere(const Triangles& triangles, const Vertices& points, Index face);

double longest_edge_on_sphere(const Triangles& triangles, const Vertices& points, Index face);

}  // namespace koebe
