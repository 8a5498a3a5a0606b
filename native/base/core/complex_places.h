// Planar points as complex numbers.
#pragma once

#include "core/types.h"

namespace koebe {

inline Complex complex_at(const PlanarPoints& points, Eigen::Index v) { return {points(v, 0), points(v, 1)}; }

inline void put_complex(PlanarPoints& points, Eigen::Index v, Complex z) { points.row(v) << z.real(), z.imag(); }

inline PlanarPoints planar_points(const VectorXcd& places)
{
    PlanarPoints points(places.size(), 2);
    points << places.real(), places.imag();
    return points;
}

}  // namespace koebe
