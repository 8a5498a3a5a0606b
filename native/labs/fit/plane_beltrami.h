// The Beltrami coefficients of a map between two planar meshes that is linear in each face.
#pragma once

#include "core/complex_places.h"

#include <Eigen/Core>

#include <cmath>

namespace koebe {

/// The edge of face f from its first corner to another one.
inline Complex face_edge(const PlanarPoints& points, const Triangles& triangles, Eigen::Index f, int corner)
{
    return complex_at(points, triangles(f, corner)) - complex_at(points, triangles(f, 0));
}

/// (F) mu of each face of the map `from` -> `to`; 1 for faces without area, and for faces that the map turns over.
inline VectorXcd plane_beltrami(const PlanarPoints& from, const Triangles& triangles, const PlanarPoints& to)
{
    const auto edge = [&](const PlanarPoints& points, Eigen::Index f, int corner) {
        return face_edge(points, triangles, f, corner);
    };
    VectorXcd mu(triangles.rows());
    for (Eigen::Index f = 0; f < mu.size(); ++f) {
        const Complex p = edge(from, f, 1), q = edge(from, f, 2), a = edge(to, f, 1), b = edge(to, f, 2);
        // The map is like z + unlike conj(z), up to a common factor.
        const Complex like = a * std::conj(q) - b * std::conj(p), unlike = b * p - a * q;
        mu[f] = std::abs(unlike) < std::abs(like) ? unlike / like : Complex(1.0);
    }
    return mu;
}

}  // namespace koebe
