#include "lift/meeting_faces.h"

#include "core/sort_unique.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Intersections_3/Triangle_3_Triangle_3.h>
#include <CGAL/box_intersection_d.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>

namespace koebe {
namespace {

using SpaceKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using FaceBox = CGAL::Box_intersection_d::Box_with_info_d<double, 3, Index>;

SpaceKernel::Triangle_3 triangle_at(const Vertices& vertices, const Triangles& triangles, Index f)
{
    const auto corner = [&](int k) {
        const Index v = triangles(f, k);
        return SpaceKernel::Point_3(vertices(v, 0), vertices(v, 1), vertices(v, 2));
    };
    return {corner(0), corner(1), corner(2)};
}

// The count ends above these, of boxes that overlap and of faces that meet.
constexpr std::int64_t least_tests = 4'000'000, tests_of_a_face = 100;
constexpr Index least_pairs = 20'000, pairs_of_a_face = 2;

struct TooManyPairs {};

using FaceCorners = std::array<Eigen::Vector3d, 3>;

FaceCorners three_corners(const Vertices& vertices, const Triangles& triangles, Index f)
{
    return {vertices.row(triangles(f, 0)), vertices.row(triangles(f, 1)), vertices.row(triangles(f, 2))};
}

/// Whether a triangle's plane, or a plane upright on it along a side, has another triangle beyond it, by more than
/// rounding can be. It spares most exact tests.
bool clearly_apart(const FaceCorners& own, const FaceCorners& other)
{
    constexpr double rounding = 1e-13;  // of the product of the lengths
    const Eigen::Vector3d normal = (own[1] - own[0]).cross(own[2] - own[0]);
    const double spans = (own[1] - own[0]).norm() * (own[2] - own[0]).norm();
    const auto beyond = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& way, double lengths) {
        for (const Eigen::Vector3d& p : other)
            if (!(way.dot(p - from) > rounding * lengths * (p - from).norm())) return false;
        return true;
    };
    if (beyond(own[0], normal, spans) || beyond(own[0], -normal, spans)) return true;
    for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d side = own[(k + 1) % 3] - own[k];
        if (beyond(own[k], side.cross(normal), side.norm() * spans)) return true;
    }
    return false;
}

bool neighbours(const Triangles& triangles, Index f, Index g)
{
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (triangles(f, i) == triangles(g, j)) return true;
    return false;
}

}  // namespace

MeetingFaces meeting_faces(const Vertices& vertices, const Triangles& triangles, const ExecutionContext& context)
{
    // Pairs whose boxes meet are tested exactly, until there are too many.
    std::vector<FaceBox> boxes;
    boxes.reserve(static_cast<std::size_t>(triangles.rows()));
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f) {
        if (triangle_at(vertices, triangles, f).is_degenerate()) continue;
        double low[3], high[3];
        for (int axis = 0; axis < 3; ++axis) {
            const auto [least, most] = std::minmax(
                {vertices(triangles(f, 0), axis), vertices(triangles(f, 1), axis), vertices(triangles(f, 2), axis)});
            low[axis] = least;
            high[axis] = most;
        }
        boxes.emplace_back(low, high, f);
    }
    MeetingFaces meeting;
    const std::int64_t most_tests = least_tests + tests_of_a_face * static_cast<std::int64_t>(triangles.rows());
    const Index most_pairs = least_pairs + pairs_of_a_face * static_cast<Index>(triangles.rows());
    std::int64_t tests = 0;
    const auto test = [&](const FaceBox& first, const FaceBox& second) {
        if (++tests % 4096 == 0) context.checkpoint();
        if (tests > most_tests || meeting.pairs > most_pairs) throw TooManyPairs();
        const Index f = first.info(), g = second.info();
        if (neighbours(triangles, f, g)) return;
        const FaceCorners own = three_corners(vertices, triangles, f), other = three_corners(vertices, triangles, g);
        if (clearly_apart(own, other) || clearly_apart(other, own) ||
            !CGAL::do_intersect(triangle_at(vertices, triangles, f), triangle_at(vertices, triangles, g)))
            return;
        ++meeting.pairs;
        meeting.faces.push_back(f);
        meeting.faces.push_back(g);
    };
    try {
        CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), test);
    } catch (const TooManyPairs&) {
        meeting.all = false;
    }
    sort_unique(meeting.faces);
    return meeting;
}

Triangles joined_corners(const Vertices& vertices, const Triangles& triangles, double near)
{
    using Cell = std::array<std::int64_t, 3>;
    const double size = 8.0 * near;
    const auto cell_of = [&](const Eigen::RowVector3d& p) {
        Cell cell{};
        for (int axis = 0; axis < 3; ++axis) cell[axis] = static_cast<std::int64_t>(std::floor(p[axis] / size));
        return cell;
    };
    // A grid whose cells are eight times the distance: a vertex looks into one cell, or a few at its sides.
    std::map<Cell, std::vector<Index>> cells;
    std::vector<Index> first(vertices.rows());
    for (Index v = 0; v < static_cast<Index>(vertices.rows()); ++v) {
        const Eigen::RowVector3d p = vertices.row(v) - vertices.row(0), step = Eigen::RowVector3d::Constant(near);
        const Cell low = cell_of(p - step), high = cell_of(p + step);
        first[v] = v;
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
            for (std::int64_t y = low[1]; y <= high[1]; ++y)
                for (std::int64_t z = low[2]; z <= high[2]; ++z)
                    if (const auto found = cells.find({x, y, z}); found != cells.end())
                        for (const Index other : found->second)
                            if ((vertices.row(other) - vertices.row(v)).norm() <= near) first[v] = first[other];
        cells[cell_of(p)].push_back(v);
    }
    // Each vertex by the first one of its place.
    Triangles joined = triangles;
    for (Eigen::Index c = 0; c < joined.size(); ++c) joined.data()[c] = first[joined.data()[c]];
    return joined;
}

}  // namespace koebe
