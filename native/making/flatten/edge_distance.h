// The distance of a point from an edge.
#pragma once

#include "core/types.h"

#include <algorithm>

namespace koebe {

/// From the point p to the edge from a to b.
inline double distance_to_edge(const Eigen::RowVector2d& p, const Eigen::RowVector2d& a, const Eigen::RowVector2d& b)
{
    const Eigen::RowVector2d along = b - a;
    const double square = along.squaredNorm();
    const double share = square > 0.0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0.0;
    return (p - a - share * along).norm();
}

}  // namespace koebe
