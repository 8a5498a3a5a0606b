#include "foldover/angle_map.h"

#include "core/length.h"
#include "core/uv_resolution.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>

namespace koebe {
namespace {

constexpr double thin = 1e-10;             // twice the area over the squared longest edge, as in quality/distortion.cpp
constexpr double lost_by_rounding = 3e-7;  // twice the area a face can lose, over its longest edge, disk units

/// exp(i angle) at the three corners of a triangle of the surface; zeros where it has no area.
std::array<Complex, 3> corner_turns(const Vertices& vertices, const Triangles& triangles, Eigen::Index f)
{
    const Eigen::RowVector3d e1 = vertices.row(triangles(f, 1)) - vertices.row(triangles(f, 0));
    const Eigen::RowVector3d e2 = vertices.row(triangles(f, 2)) - vertices.row(triangles(f, 0));
    const double length = length_of(e1);
    if (!(length > 0.0)) return {};
    const Eigen::RowVector3d direction = e1 / length, arm = e2 / length;
    const Complex apex(direction.dot(arm), length_of(direction.cross(arm)));  // over the edge from 0 to 1
    if (!(apex.imag() > thin * std::max({1.0, std::norm(apex), std::norm(apex - 1.0)}))) return {};
    const Complex first = apex, second = std::conj(1.0 - apex), third = times_conjugate(apex - 1.0, apex);
    return {first / std::abs(first), second / std::abs(second), third / std::abs(third)};
}

}  // namespace

AngleMap::AngleMap(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& uv)
    : points(uv.rows()),
      error(triangles.size(), 0.0),
      mobility(uv.rows(), Mobility::free),
      triangles_(triangles),
      turn_(triangles.size()),
      least_area_(triangles.rows()),
      begin_(uv.rows() + 1, 0),
      corners_(triangles.size()),
      slide_of_(uv.rows(), -1)
{
    for (Eigen::Index v = 0; v < uv.rows(); ++v) points[v] = {uv(v, 0), uv(v, 1)};
    for (Eigen::Index i = 0; i < triangles.size(); ++i) ++begin_[triangles.data()[i] + 1];
    for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
    std::vector<Index> cursor(begin_.begin(), begin_.end() - 1);
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f) {
        const std::array<Complex, 3> turns = corner_turns(vertices, triangles, f);
        const auto at = [&](int k) { return points[triangles(f, k % 3)]; };
        double longest = 0.0;
        for (int k = 0; k < 3; ++k) {
            const Index after = (k + 1) % 3, before = (k + 2) % 3;
            corners_[cursor[triangles(f, k)]++] = {3 * f + k, 3 * f + after, 3 * f + before, triangles(f, after),
                                                   triangles(f, before)};
            turn_[3 * f + k] = turns[k];
            longest = std::max(longest, std::abs(at(k + 1) - at(k)));
        }
        if (turns[0] != 0.0) counted_ += 3;
        // A face above the resolution of 32 bits keeps an area; others may not.
        if (longest >= 2.0 * uv_resolution)
            least_area_[f] = std::min(lost_by_rounding * longest, cross(at(1) - at(0), at(2) - at(0)));
    }
}

Complex AngleMap::slid(Index v, double length) const
{
    const Circle& circle = slide(v).circle;
    return circle.center + std::polar(circle.radius, std::arg(points[v] - circle.center) + length / circle.radius);
}

void AngleMap::let_slide(Index v, const Slide& slide)
{
    mobility[v] = Mobility::sliding;
    slide_of_[v] = static_cast<Index>(slides_.size());
    slides_.push_back(slide);
}

double AngleMap::measure()
{
    double sum = 0.0;
    for (Index f = 0; f < static_cast<Index>(triangles_.rows()); ++f) {
        if (turn_[3 * f] == 0.0) continue;
        const Complex corner = points[triangles_(f, 0)];
        const FaceErrors now = face_errors({3 * f, 3 * f + 1, 3 * f + 2, 0, 0}, points[triangles_(f, 1)] - corner,
                                           points[triangles_(f, 2)] - corner);
        error[3 * f] = now.own;
        error[3 * f + 1] = now.after;
        error[3 * f + 2] = now.before;
        sum += now.sum();
    }
    return sum;
}

}  // namespace koebe
