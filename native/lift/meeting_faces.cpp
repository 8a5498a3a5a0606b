#include "lift/meeting_faces.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Intersections_3/Triangle_3_Triangle_3.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>

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

bool neighbours(const Triangles& triangles, Index f, Index g)
{
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (triangles(f, i) == triangles(g, j)) return true;
    return false;
}

}  // namespace

MeetingFaces meeting_faces(const Vertices& vertices, const Triangles& triangles)
{
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
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const FaceBox& first, const FaceBox& second) {
        const Index f = first.info(), g = second.info();
        if (neighbours(triangles, f, g) ||
            !CGAL::do_intersect(triangle_at(vertices, triangles, f), triangle_at(vertices, triangles, g)))
            return;
        ++meeting.pairs;
        meeting.faces.push_back(f);
        meeting.faces.push_back(g);
    });
    std::ranges::sort(meeting.faces);
    meeting.faces.erase(std::unique(meeting.faces.begin(), meeting.faces.end()), meeting.faces.end());
    return meeting;
}

}  // namespace koebe
