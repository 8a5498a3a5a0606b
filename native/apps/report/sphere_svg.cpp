#include "report/sphere_svg.h"

#include "core/sort_unique.h"
#include "report/edge_trails.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace koebe {
namespace {

constexpr double ball_size = 10000.0;  // picture units per radius
constexpr int cap_corners = 180;

/// A view from the front, with +y away from the eye and +x to the right, or from behind.
struct BallView {
    double side;  // 1 in front, -1 behind

    double across(const SpherePoint& p) const { return side * p[0]; }
    double toward(const SpherePoint& p) const { return -side * p[1]; }
    std::string place(const SpherePoint& p) const
    {
        return std::to_string(std::lround(ball_size * across(p))) + " " +
               std::to_string(std::lround(-ball_size * p[2]));
    }
};

/// Edges with both ends on the visible side, in few strokes.
std::string seen_edges(const Triangles& triangles, const Vertices& points, const BallView& view)
{
    std::vector<Edge> edges;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const Index a = triangles(f, k), b = triangles(f, (k + 1) % 3);
            if (view.toward(points.row(a)) >= 0.0 && view.toward(points.row(b)) >= 0.0)
                edges.push_back({std::min(a, b), std::max(a, b)});
        }
    sort_unique(edges);
    std::string path;
    for (const std::vector<Index>& trail : edge_trails(edges, static_cast<Index>(points.rows())))
        for (std::size_t i = 0; i < trail.size(); ++i) path += (i == 0 ? 'M' : 'L') + view.place(points.row(trail[i]));
    return path;
}

/// The visible part of a cap of at most half the sphere: corners behind move to the rim of the ball.
std::string seen_small_cap(const Cap& cap, const BallView& view)
{
    const SpherePoint x = cap.center.unitOrthogonal(), y = cap.center.cross(x);
    std::string path;
    bool seen = false;
    for (int i = 0; i < cap_corners; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / cap_corners;
        SpherePoint p =
            std::cos(cap.radius) * cap.center + std::sin(cap.radius) * (std::cos(angle) * x + std::sin(angle) * y);
        if (view.toward(p) >= 0.0) {
            seen = true;
        } else {
            p[1] = 0.0;
            const double length = p.norm();
            if (length > 0.0) p /= length;
        }
        path += (i == 0 ? 'M' : 'L') + view.place(p);
    }
    return seen ? path + "z" : "";
}

/// The visible part of a cap, for the even-odd rule: for a large cap the ball without the rest.
std::string seen_cap(const Cap& cap, const BallView& view)
{
    if (cap.radius <= 0.5 * std::numbers::pi) return seen_small_cap(cap, view);
    const std::string ball = "M-10000 0A10000 10000 0 1 0 10000 0A10000 10000 0 1 0 -10000 0z";
    return ball + seen_small_cap({-cap.center, std::numbers::pi - cap.radius}, view);
}

}  // namespace

std::string sphere_svg(const Triangles& triangles, const SphereResult& result)
{
    const double width = std::clamp(600.0 / std::sqrt(static_cast<double>(triangles.rows()) + 1.0), 2.0, 40.0);
    std::string svg =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-10500 -10500 43000 21000\" width=\"1000\">\n"
        "<title>a sphere from the front and from behind</title>\n"
        "<defs><radialGradient id=\"ball\" cx=\"0.36\" cy=\"0.3\" r=\"0.8\"><stop offset=\"0\" stop-color=\"#f4f8ff\"/>"
        "<stop offset=\"0.6\" stop-color=\"#a9c3e8\"/><stop offset=\"1\" "
        "stop-color=\"#5d7fb0\"/></radialGradient></defs>\n"
        "<rect x=\"-10500\" y=\"-10500\" width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
    for (const BallView view : {BallView{1.0}, BallView{-1.0}}) {
        svg +=
            "<g transform=\"translate(" + std::string(view.side > 0.0 ? "0" : "22000") +
            " 0)\"><circle r=\"10000\" fill=\"url(#ball)\"/>\n<path fill=\"none\" stroke=\"#33415c\" stroke-width=\"" +
            std::to_string(std::lround(width)) + "\" stroke-linejoin=\"round\" d=\"" +
            seen_edges(triangles, result.points, view) +
            "\"/>\n<path fill=\"#f4e3d0\" fill-rule=\"evenodd\" stroke=\"#8a5a2b\" "
            "stroke-width=\"60\" d=\"";
        for (const SphereLoop& loop : result.loops) svg += seen_cap(loop.cap, view);
        svg += "\"/></g>\n";
    }
    return svg + "</svg>\n";
}

}  // namespace koebe
