// Faces that have their corners in another order: they were turned to one orientation.
#pragma once

#include "core/types.h"

namespace koebe {

/// The corner of a face that has this vertex, the first one if there are several. @return 0, 1 or 2
inline int corner_with(const Triangles& triangles, Eigen::Index f, Index vertex)
{
    return vertex == triangles(f, 0) ? 0 : vertex == triangles(f, 1) ? 1 : 2;
}

/// Values of the corners of faces, for the same faces with their corners in another order.
/// @param values (3F, 2) by the corners of `from` @return (3F, 2) by the corners of `to`
inline PlanarPoints in_corner_order(const PlanarPoints& values, const Triangles& from, const Triangles& to)
{
    PlanarPoints ordered(values.rows(), 2);
    for (Eigen::Index f = 0; f < to.rows(); ++f)
        for (int k = 0; k < 3; ++k) ordered.row(3 * f + k) = values.row(3 * f + corner_with(from, f, to(f, k)));
    return ordered;
}

}  // namespace koebe
