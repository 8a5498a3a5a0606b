// Finds the triangles of a map to the sphere that hold given points.
#pragma once

#include "core/api.h"
#include "core/types.h"
#include "surface/surface_point.h"

#include <vector>

namespace koebe {

/// A walk over edges, from a triangle nearby, into the triangle whose sides all have the point on the left.
class SpherePlaces {
public:
    /// @param points (V, 3) unit vectors @param triangles (F, 3) closed; each point of the sphere is covered once
    KOEBE_API SpherePlaces(Vertices points, Triangles triangles);

    /// The triangle that a direction goes through, and the barycentric coordinates of the flat triangle's point there.
    /// @param start a triangle nearby, or -1 @throws SolverError if no triangle holds it, to 1e-6 of its size
    KOEBE_API SurfacePoint at(const Eigen::Vector3d& place, Index start = -1) const;

private:
    Eigen::Vector3d sides(const Eigen::Vector3d& place, Index face) const;

    Vertices points_;
    Triangles triangles_;
    std::vector<Index> across_;  // (3 F) the triangle opposite to each corner
    std::vector<Index> near_;    // a triangle near the middle of each square of a cube round the sphere
    int squares_ = 1;            // along an edge of the cube
};

}  // namespace koebe
