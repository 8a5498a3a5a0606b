#include "even/even_dial.h"

#include "circles/circle_fit.h"
#include "core/all_elements.h"
#include "core/errors.h"
#include "foldover/newton_system.h"
#include "mesh/topology.h"
#include "planar/planar_predicates.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace koebe {
namespace {

constexpr double most = 0.6;           // of a loop: so many vertices on one circle make it round
constexpr double stored = 2e-7;        // over the extent: rounding of 32-bit UVs
constexpr double on_circle = 1e-5;     // over the radius: vertices as near as this lie on it, as 32-bit UVs
constexpr double extent_factor = 2.0;  // extent that the map may get, over its present one
constexpr double least_even = 1e-4;    // at 0 nothing would move: this is 0, as far as one sees

/// The circle on which most vertices of a loop lie, with these vertices. Vertices far off, such as ears, are left out.
/// @param rounding of the points
std::optional<RoundLoop> on_one_circle(const VertexLoop& loop, const PlanarPoints& points, double rounding)
{
    RoundLoop round{loop, {}};
    while (round.vertices.size() > 3 &&
           static_cast<double>(round.vertices.size()) >= most * static_cast<double>(loop.size())) {
        VectorXcd at(static_cast<Eigen::Index>(round.vertices.size()));
        for (std::size_t i = 0; i < round.vertices.size(); ++i)
            at[static_cast<Eigen::Index>(i)] = Complex(points(round.vertices[i], 0), points(round.vertices[i], 1));
        round.track.circle = fit_circle_least_squares(at);
        const VectorXd off = ((at.array() - round.track.circle.center).abs() - round.track.circle.radius).abs();
        const double worst = off.maxCoeff();
        if (worst <= std::max(on_circle * round.track.circle.radius, rounding)) return round;
        std::vector<Index> nearer;
        for (std::size_t i = 0; i < round.vertices.size(); ++i)
            if (off[static_cast<Eigen::Index>(i)] < 0.5 * worst) nearer.push_back(round.vertices[i]);
        round.vertices = std::move(nearer);
    }
    return {};
}

}  // namespace

EvenDial::EvenDial(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& points, bool round)
    : vertices_(vertices), points_(points), pattern_(std::make_shared<NewtonPattern>())
{
    validate_arrays(vertices, triangles);
    if (points.rows() != vertices.rows() || !points.allFinite())
        throw InputError("the map must have a finite point for each vertex");
    Surface surface = analyze_surface(triangles, static_cast<Index>(vertices.rows()));
    if (surface.loops.empty()) throw TopologyError(TopologyKind::closed, "a closed surface has no flat map", {0});
    // Every vertex in a face, every face upright: else there is no energy to start from.
    std::vector<char> used(static_cast<std::size_t>(vertices.rows()), 0);
    for (const Index v : triangles.reshaped()) used[v] = 1;
    std::vector<Index> unused;
    for (std::size_t v = 0; v < used.size(); ++v)
        if (!used[v]) unused.push_back(static_cast<Index>(v));
    if (!unused.empty()) throw InputError("the map has vertices that belong to no face", ElementKind::vertices, unused);
    triangles_ = std::move(surface.triangles);
    loops_ = std::move(surface.loops);
    double image = 0.0;
    std::vector<Index> turned;
    for (Eigen::Index f = 0; f < triangles_.rows(); ++f) {
        const double area = signed_area(points, triangles_, f);
        image += area;
        if (!(area > 0.0)) turned.push_back(static_cast<Index>(f));
    }
    if (!turned.empty())
        throw InputError("the map has faces that are turned over, or without area", ElementKind::faces, turned);
    // In the units of the surface, so that a face true to size has the determinant 1.
    scale_ = scale_to_size(vertices_, triangles_, image);
    if (!std::isfinite(scale_) || !(scale_ > 0.0))
        throw InputError("the surface has no area", ElementKind::faces, all_elements(triangles_.rows()));
    points_ *= scale_;
    extent_ = extent_factor * (points_.colwise().maxCoeff() - points_.colwise().minCoeff()).maxCoeff();
    if (!round) return;
    for (const VertexLoop& loop : loops_)
        if (auto one = on_one_circle(loop, points_, stored * extent_)) round_.push_back(std::move(*one));
}

bool EvenDial::move(double even, int most_steps, ExecutionContext& context)
{
    require_even(even);
    PlanarPoints points = points_;
    std::vector<RoundLoop> round = round_;
    const EvenMap moved = make_even({vertices_, triangles_, loops_, points, round}, std::max(even, least_even), extent_,
                                    context, {most_steps, 0, most_steps}, pattern_.get());
    if (!moved.moved) return false;
    points_ = std::move(points);
    round_ = std::move(round);
    return true;
}

}  // namespace koebe
