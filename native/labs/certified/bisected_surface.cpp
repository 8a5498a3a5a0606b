#include "certified/bisected_surface.h"

#include "core/connectivity.h"
#include "core/errors.h"

#include <algorithm>
#include <cmath>

namespace koebe {
namespace {

// Two cuts add one binary digit to a corner's coordinates, which have 52. Faces below are cut only with their
// neighbours.
constexpr int deepest = 80;

/// x times a power of two.
Interval scaled(double x, int exponent)
{
    const double y = std::ldexp(x, exponent);
    return std::ldexp(y, -exponent) == x ? Interval(y) : Interval(below(y), above(y));
}

Interval squared_cross(const std::array<Interval, 3>& a, const std::array<Interval, 3>& b)
{
    Interval sum;
    for (int k = 0; k < 3; ++k) sum = sum + squared(a[k] * b[(k + 1) % 3] - a[(k + 1) % 3] * b[k]);
    return sum;
}

double middle(const Interval& x) { return 0.5 * (x.lower + x.upper); }

/// The corner from which the longest edge leaves.
int longest_edge(const Vertices& vertices, const Triangles& triangles, Eigen::Index f)
{
    int longest = 0;
    double most = -1.0;
    for (int k = 0; k < 3; ++k) {
        const double length = (vertices.row(triangles(f, (k + 1) % 3)) - vertices.row(triangles(f, k))).norm();
        if (length > most) {
            longest = k;
            most = length;
        }
    }
    return longest;
}

}  // namespace

BisectedSurface::BisectedSurface(const Vertices& vertices, const Surface& surface)
    : triangles_(surface.triangles), loop_count_(static_cast<int>(surface.loops.size()))
{
    std::vector<Index> number(surface.vertex_count, 0);
    for (const Index v : surface.unused) number[v] = -1;
    Index used = 0;
    for (Index& n : number)
        if (n == 0) n = used++;
    loop_of_.assign(used, -1);
    for (int k = 0; k < loop_count_; ++k)
        for (const Index v : surface.loops[k]) loop_of_[number[v]] = k;

    // A power of two: the largest coordinate comes near 1, so that no square is out of range.
    double largest = 0.0;
    for (const Index v : surface.triangles.reshaped())
        largest = std::max(largest, vertices.row(v).cwiseAbs().maxCoeff());
    const int exponent = largest > 0.0 ? -std::ilogb(largest) : 0;
    const Vertices near_one = vertices.unaryExpr([&](double x) { return std::ldexp(x, exponent); });
    std::vector<Index> flat;
    for (Eigen::Index f = 0; f < triangles_.rows(); ++f) {
        const int first = longest_edge(near_one, surface.triangles, f);
        Plane plane;
        for (int k = 0; k < 3; ++k) triangles_(f, k) = surface.triangles(f, (first + k) % 3);
        for (int k = 0; k < 3; ++k) {
            const Interval origin = scaled(vertices(triangles_(f, 0), k), exponent);
            plane.a[k] = scaled(vertices(triangles_(f, 1), k), exponent) - origin;
            plane.b[k] = scaled(vertices(triangles_(f, 2), k), exponent) - origin;
        }
        const Interval twice_area = square_root(squared_cross(plane.a, plane.b));
        if (!(twice_area.lower > 0.0)) {
            flat.push_back(static_cast<Index>(f));
            continue;
        }
        plane.per_energy = Interval(0.5) / twice_area;
        planes_.push_back(plane);
        for (int k = 0; k < 3; ++k) triangles_(f, k) = number[triangles_(f, k)];
        corners_.push_back({0.0, 0.0, 1.0, 0.0, 0.0, 1.0});
        depth_.push_back(0);
        input_face_.push_back(static_cast<Index>(f));
    }
    if (!flat.empty())
        throw InputError("faces have no area, or none that rounding leaves: their metric is not known",
                         ElementKind::faces, flat);
    twin_ = pair_halfedges(triangles_, used);
}

EdgeLengths BisectedSurface::lengths() const
{
    EdgeLengths lengths(triangles_.rows(), 3);
    for (Eigen::Index f = 0; f < triangles_.rows(); ++f) {
        const Plane& plane = planes_[input_face_[f]];
        const Corners& at = corners_[f];
        for (int k = 0; k < 3; ++k) {
            const int next = (k + 1) % 3;
            const double x = at[2 * next] - at[2 * k], y = at[2 * next + 1] - at[2 * k + 1];
            double sum = 0.0;
            for (int i = 0; i < 3; ++i) sum += std::pow(x * middle(plane.a[i]) + y * middle(plane.b[i]), 2);
            lengths(f, k) = std::sqrt(sum);
        }
    }
    return lengths;
}

Interval BisectedSurface::energy(Index f, const Interval& to_corner_1, const Interval& to_corner_2) const
{
    // With d the integrals, e the edges in coordinates and D = det(e1, e2): the covector is (p, q) / D in coordinates,
    // p = d1 y2 - d2 y1, q = x1 d2 - x2 d1. It turns by 90 degrees into (p b - q a) / |a x b| / D, of the same length,
    // on an area of |a x b| D / 2.
    const Plane& plane = planes_[input_face_[f]];
    const Corners& at = corners_[f];
    const Interval x1 = at[2] - at[0], y1 = at[3] - at[1], x2 = at[4] - at[0], y2 = at[5] - at[1];
    const Interval p = to_corner_1 * y2 - to_corner_2 * y1, q = x1 * to_corner_2 - x2 * to_corner_1;
    Interval sum;
    for (int k = 0; k < 3; ++k) sum = sum + squared(p * plane.b[k] - q * plane.a[k]);
    return sum * plane.per_energy * std::ldexp(1.0, depth_[f]);
}

void BisectedSurface::refine(const std::vector<char>& marked)
{
    const Index count = static_cast<Index>(triangles_.size());
    // An edge that is cut cuts the first edge of its faces too.
    std::vector<Index> middle_of(count, -1), queue;
    const auto cut = [&](Index h) {
        if (middle_of[h] >= 0) return;
        middle_of[h] = 0;
        queue.push_back(face_of(h));
        if (twin_[h] == no_twin) return;
        middle_of[twin_[h]] = 0;
        queue.push_back(face_of(twin_[h]));
    };
    for (Index f = 0; f < face_count(); ++f)
        for (int k = 0; k < 3; ++k)
            if (marked[f] && depth_[f] < deepest) cut(3 * f + k);
    for (std::size_t head = 0; head < queue.size(); ++head) cut(3 * queue[head]);

    for (Index h = 0; h < count; ++h) {
        if (middle_of[h] < 0 || (twin_[h] != no_twin && twin_[h] < h)) continue;
        middle_of[h] = vertex_count();
        if (twin_[h] != no_twin) middle_of[twin_[h]] = vertex_count();
        loop_of_.push_back(twin_[h] == no_twin ? loop_of_[origin(triangles_, h)] : -1);
    }

    std::vector<std::array<Index, 3>> faces;
    std::vector<Corners> corners;
    std::vector<std::uint8_t> depth;
    std::vector<Index> input_face;
    // Adds the triangle, cut at its first edge if there is a vertex m there, and each half at its own first edge.
    const auto add = [&](const auto& self, const std::array<Index, 3>& v, const Corners& at, int level, Index f,
                         std::array<Index, 3> m) -> void {
        if (m[0] < 0) {
            faces.push_back(v);
            corners.push_back(at);
            depth.push_back(static_cast<std::uint8_t>(level));
            input_face.push_back(f);
            return;
        }
        const double x = 0.5 * (at[0] + at[2]), y = 0.5 * (at[1] + at[3]);
        self(self, {v[2], v[0], m[0]}, {at[4], at[5], at[0], at[1], x, y}, level + 1, f, {m[2], -1, -1});
        self(self, {v[1], v[2], m[0]}, {at[2], at[3], at[4], at[5], x, y}, level + 1, f, {m[1], -1, -1});
    };
    for (Index f = 0; f < face_count(); ++f)
        add(add, {triangles_(f, 0), triangles_(f, 1), triangles_(f, 2)}, corners_[f], depth_[f], input_face_[f],
            {middle_of[3 * f], middle_of[3 * f + 1], middle_of[3 * f + 2]});
    triangles_.resize(static_cast<Eigen::Index>(faces.size()), 3);
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (int k = 0; k < 3; ++k) triangles_(static_cast<Eigen::Index>(f), k) = faces[f][k];
    corners_ = std::move(corners);
    depth_ = std::move(depth);
    input_face_ = std::move(input_face);
    twin_ = pair_halfedges(triangles_, vertex_count());
}

}  // namespace koebe
