// Circle domains as surfaces in the plane, with a map that tests disturb.
#pragma once

#include "circle_domain.h"
#include "mesh/topology.h"

#include <utility>

namespace koebe::test {

/// The points as rows.
inline PlanarPoints planar(const VectorXcd& points)
{
    PlanarPoints result(points.size(), 2);
    result << points.real(), points.imag();
    return result;
}

/// A circle domain mapped to itself.
struct PlanarMap {
    explicit PlanarMap(CircleDomain d)
        : domain(std::move(d)),
          vertices(lift(domain.points, Lift::plane)),
          surface(require_bordered_genus_zero(domain.triangles, static_cast<Index>(domain.points.size()))),
          uv(vertices.leftCols<2>())
    {
    }

    CircleDomain domain;
    Vertices vertices;
    Surface surface;
    PlanarPoints uv;
};

}  // namespace koebe::test
