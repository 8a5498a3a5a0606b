// Angles of a triangle on the surface and of its image, for any unit of the surface.
#pragma once

#include "core/types.h"

#include <array>

namespace koebe {

struct AngleError {  ///< degrees, |angle in UV - angle on the surface| over all corners
    double mean = 0.0, sd = 0.0, max = 0.0;
};

/// A triangle of the surface laid into the plane: corners 0, p1 = (length, 0), p2.
struct FlatTriangle {
    double p1x = 0.0, p2x = 0.0, p2y = 0.0;

    double area() const { return 0.5 * p1x * p2y; }
    /// Whether the triangle is thick enough to have angles.
    bool has_angles() const;
};

/// The faces of a surface, laid flat one by one, in a unit that is a power of 2, so that no area over- or underflows.
class FlatFaces {
public:
    FlatFaces(const Vertices& vertices, const Triangles& triangles);

    /// @param corners their order in the triangle
    FlatTriangle operator()(Eigen::Index f, const std::array<int, 3>& corners = {0, 1, 2}) const;

private:
    const Vertices& vertices_;
    const Triangles& triangles_;
    double unit_ = 1.0;
};

/// Degrees, |angle - angle of the image| at the three corners, with positive angles. The image has the corners 0, a, b.
/// Where two of these coincide, their side has no direction: the angles at its ends count as right angles, as in the
/// thinnest isosceles triangle.
std::array<double, 3> angle_errors(const FlatTriangle& flat, double ax, double ay, double bx, double by);

/// Errors of many corners.
struct AngleSums {
    double sum = 0.0, squares = 0.0, most = 0.0, corners = 0.0;

    void add(const std::array<double, 3>& errors);
    void add(const AngleSums& more);
    AngleError error() const;
};

}  // namespace koebe
