// Circle domains as surfaces in the plane, with a map that tests disturb.
#pragma once

#include "circle_domain.h"
#include "mesh/topology.h"

#include <algorithm>
#include <array>
#include <utility>

namespace koebe::test {

/// The points as rows.
inline PlanarPoints planar(const VectorXcd& points)
{
    PlanarPoints result(points.size(), 2);
    result << points.real(), points.imag();
    return result;
}

/// Two faces in the plane z = 0. @param corners x and y of four vertices
struct TwoFaces {
    TwoFaces(std::array<double, 8> corners, std::array<Index, 6> faces)
    {
        for (Index v = 0; v < 4; ++v) vertices.row(v) << corners[2 * v], corners[2 * v + 1], 0.0;
        std::ranges::copy(faces, triangles.reshaped<Eigen::RowMajor>().begin());
    }

    Vertices vertices{4, 3};
    Triangles triangles{2, 3};
};

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
