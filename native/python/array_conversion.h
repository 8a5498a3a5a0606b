// Converts plane points and lists of numbers for Python.
#pragma once

#include "circles/circle.h"
#include "core/errors.h"
#include "core/types.h"

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>

#include <vector>

namespace koebe::python {

// NumPy's arrays as arguments, without a copy.
using Positions = const Eigen::Ref<const Vertices>&;
using Faces = const Eigen::Ref<const Triangles>&;
using Points = const Eigen::Ref<const PlanarPoints>&;

inline pybind11::array_t<Index> array_of(const std::vector<Index>& numbers)
{
    return pybind11::array_t<Index>(numbers.size(), numbers.data());
}

/// @throws SolverError a position that is not finite
inline PlanarPoints planar(const VectorXcd& positions)
{
    PlanarPoints points(positions.size(), 2);
    points << positions.real(), positions.imag();
    if (!points.allFinite()) throw SolverError("the map has positions that are not finite");
    return points;
}

inline VectorXcd complex(Points points) { return points.col(0) + Complex(0.0, 1.0) * points.col(1); }

/// Circles from (L, 2) centres and (L) radii.
inline std::vector<Circle> circles_of(const PlanarPoints& centers, const VectorXd& radii)
{
    std::vector<Circle> circles;
    for (Eigen::Index k = 0; k < radii.size(); ++k)
        circles.push_back({Complex(centers(k, 0), centers(k, 1)), radii[k]});
    return circles;
}

/// (L, 2) centres and (L) radii of circles.
inline std::pair<PlanarPoints, VectorXd> arrays_of(const std::vector<Circle>& circles)
{
    PlanarPoints centers(static_cast<Eigen::Index>(circles.size()), 2);
    VectorXd radii(centers.rows());
    for (Eigen::Index k = 0; k < radii.size(); ++k) {
        const Circle& circle = circles[static_cast<std::size_t>(k)];
        centers.row(k) << circle.center.real(), circle.center.imag();
        radii[k] = circle.radius;
    }
    return {centers, radii};
}

}  // namespace koebe::python
