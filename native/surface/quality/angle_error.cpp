#include "quality/angle_error.h"

#include "core/length.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace koebe {
namespace {

constexpr double degrees_of_a_radian = 180.0 / std::numbers::pi;
constexpr double thin_face = 1e-10;  // twice the area over the squared longest edge, dimensionless
constexpr int widest_unit = 1000;    // binary exponent: the unit and its inverse must be doubles

/// A corner between two sides, by its cosine and sine, both times the sides' lengths.
struct CornerAngle {
    double cosine, sine;
    bool sides = true;  ///< whether both sides have a direction; else the angle is a right angle

    CornerAngle(double ax, double ay, double bx, double by)
        : cosine(ax * bx + ay * by), sine(std::abs(ax * by - ay * bx))
    {
        if (std::abs(cosine) + sine > 0.0) return;
        cosine = 0.0;
        sine = 1.0;
        sides = false;
    }
};

/// The angle from one corner to another.
double change(const CornerAngle& from, const CornerAngle& to)
{
    return std::atan2(to.sine * from.cosine - to.cosine * from.sine, from.cosine * to.cosine + from.sine * to.sine);
}

}  // namespace

bool FlatTriangle::has_angles() const
{
    const double height_squared = p2y * p2y, rest = p2x - p1x;
    const double longest_squared = std::max({p1x * p1x, p2x * p2x + height_squared, rest * rest + height_squared});
    return 2.0 * area() > thin_face * longest_squared;
}

FlatFaces::FlatFaces(const Vertices& vertices, const Triangles& triangles) : vertices_(vertices), triangles_(triangles)
{
    double largest = 0.0;
    for (Eigen::Index c = 0; c < triangles.size(); ++c)
        largest = std::max(largest, vertices.row(triangles.data()[c]).cwiseAbs().maxCoeff());
    if (largest > 0.0 && std::isfinite(largest))
        unit_ = std::ldexp(1.0, std::clamp(-std::ilogb(largest), -widest_unit, widest_unit));
}

FlatTriangle FlatFaces::operator()(Eigen::Index f, const std::array<int, 3>& corners) const
{
    const auto corner = [&](std::size_t k) -> Eigen::RowVector3d {
        return unit_ * vertices_.row(triangles_(f, corners[k]));
    };
    const Eigen::RowVector3d a = corner(0), e1 = corner(1) - a, e2 = corner(2) - a;
    const double length = length_of(e1);
    if (!(length > 0.0)) return {};
    const Eigen::RowVector3d direction = e1 / length;
    return {length, direction.dot(e2), length_of(direction.cross(e2))};
}

std::array<double, 3> angle_errors(const FlatTriangle& flat, double ax, double ay, double bx, double by)
{
    const double rest = flat.p2x - flat.p1x;
    const CornerAngle one(ax, ay, bx, by), two(-ax, -ay, bx - ax, by - ay);
    const double first = change({flat.p1x, 0.0, flat.p2x, flat.p2y}, one);
    const double second = change({-flat.p1x, 0.0, rest, flat.p2y}, two);
    double third = first + second;  // the third angle changes by the sum of the others
    if (!one.sides || !two.sides)
        third = change({-flat.p2x, -flat.p2y, -rest, -flat.p2y}, {-bx, -by, ax - bx, ay - by});
    return {degrees_of_a_radian * std::abs(first), degrees_of_a_radian * std::abs(second),
            degrees_of_a_radian * std::abs(third)};
}

void AngleSums::add(const std::array<double, 3>& errors)
{
    for (const double error : errors) {
        sum += error;
        squares += error * error;
        most = std::max(most, error);
        corners += 1.0;
    }
}

void AngleSums::add(const AngleSums& more)
{
    sum += more.sum;
    squares += more.squares;
    most = std::max(most, more.most);
    corners += more.corners;
}

AngleError AngleSums::error() const
{
    if (!(corners > 0.0)) return {};
    const double mean = sum / corners;
    return {mean, std::sqrt(std::max(squares / corners - mean * mean, 0.0)), most};
}

}  // namespace koebe
