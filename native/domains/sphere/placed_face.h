// Places a single face of the sphere in the UVs.
#pragma once

#include "sphere/sphere_map.h"

#include <Eigen/Core>

#include <array>
#include <span>

namespace koebe {

using SphereCorners = std::array<SpherePoint, 3>;

struct PlacedFace {
    std::array<Eigen::RowVector2d, 3> uv;
    bool crossing = false;  ///< goes beyond the layout's edge
    bool torn = false;      ///< contains a cone point that is none of its corners
};

/// The nearest multiple of 2^-23.
double on_uv_steps(double t);

/// The points where the layout has less than a full angle: the poles, or the middles of the square's sides.
std::span<const SpherePoint> cone_points(SphereLayout layout);

/// Whether the triangle with the shorter arcs as sides contains a point, sides included.
bool face_contains(const SphereCorners& corners, const SpherePoint& point);

/// The UVs of a face's corners (sphere_layout.h). @param turned whether the face has the other orientation
PlacedFace place_face(const SphereCorners& corners, SphereLayout layout, bool turned);

}  // namespace koebe
