#include "even/even_dial.h"

#include "circles/circle_fit.h"
#include "core/all_elements.h"
#include "core/complex_places.h"
#include "core/errors.h"
#include "core/numbering.h"
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
constexpr EvenEffort effort_at_pins{15, 4, 30};
constexpr double least_even = 1e-4;  // at 0 nothing would move: this is 0, as far as one sees

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

/// Whether the pins leave no freedom to the similarity of the map, so that the map bends.
bool bends(const Pins& pins) { return pins.count() > 2; }

Pins scaled(const Pins& pins, double scale) { return {pins.vertices, pins.places * scale}; }

double extent_of(const PlanarPoints& points)
{
    return extent_factor * (points.colwise().maxCoeff() - points.colwise().minCoeff()).maxCoeff();
}

double image_area(const Triangles& triangles, const PlanarPoints& points)
{
    double area = 0.0;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) area += signed_area(points, triangles, f);
    return area;
}

}  // namespace

EvenDial::EvenDial(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& points, bool round)
    : vertices_(vertices), form_{points, {}}, pattern_(std::make_shared<NewtonPattern>())
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
    std::vector<Index> turned;
    for (Eigen::Index f = 0; f < triangles_.rows(); ++f)
        if (!(signed_area(points, triangles_, f) > 0.0)) turned.push_back(static_cast<Index>(f));
    if (!turned.empty())
        throw InputError("the map has faces that are turned over, or without area", ElementKind::faces, turned);
    // In the units of the surface, so that a face true to size has the determinant 1.
    form_.scale = scale_to_size(vertices_, triangles_, image_area(triangles_, points));
    if (!std::isfinite(form_.scale) || !(form_.scale > 0.0))
        throw InputError("the surface has no area", ElementKind::faces, all_elements(triangles_.rows()));
    form_.points *= form_.scale;
    form_.extent = extent_of(form_.points);
    if (!round) return;
    for (const VertexLoop& loop : loops_)
        if (auto one = on_one_circle(loop, form_.points, stored * form_.extent)) form_.round.push_back(std::move(*one));
}

PlanarPoints EvenDial::points() const
{
    PlanarPoints points = form_.points / form_.scale;
    for (std::size_t i = 0; i < pins_.vertices.size(); ++i)
        points.row(pins_.vertices[i]) = pins_.places.row(static_cast<Eigen::Index>(i));
    return points;
}

bool EvenDial::move(double even, int most_steps, ExecutionContext& context)
{
    require_even(even);
    Form form = form_;
    FlatSurface flat = view(form);
    if (bends(pins_)) flat.held = pins_.vertices;
    const EvenMap moved =
        make_even(flat, std::max(even, least_even), form.extent, context, {most_steps, 0, most_steps}, pattern_.get());
    if (!moved.moved) return false;
    if (!bends(pins_)) place(pins_, form);
    form_ = std::move(form);
    return true;
}

void EvenDial::pin(const Pins& pins, double even, ExecutionContext& context)
{
    require_even(even);
    require_pins(pins, triangles_, vertices_.rows());
    if (bends(pins) && !form_.round.empty())
        throw InputError("three pins or more bend round loops: let the loops be free");
    Form form = form_;
    place(pins, form);
    if (bends(pins)) bend(pins, std::max(even, least_even), form, context);
    form_ = std::move(form);
    pins_ = pins;
}

/// Moves the map by the similarity for the pins, and keeps its size in the unit of the vertices.
void EvenDial::place(const Pins& pins, Form& form)
{
    if (pins.vertices.empty()) return;
    const PinPlacement placement = placement_at_pins(scaled(pins, form.scale), form.points);
    const double factor = std::abs(placement.factor);
    for (Eigen::Index v = 0; v < form.points.rows(); ++v)
        put_complex(form.points, v, placement(complex_at(form.points, v)) / factor);
    for (RoundLoop& loop : form.round) loop.track.circle.center = placement(loop.track.circle.center) / factor;
    form.scale /= factor;
    form.extent = std::max(extent_of(form.points), form.points.cwiseAbs().maxCoeff());
}

void EvenDial::bend(const Pins& pins, double even, Form& form, ExecutionContext& context) const
{
    const std::vector<Index> missed =
        draw_to_pins(view(form), scaled(pins, form.scale), even, form.extent, context, pattern_.get());
    if (!missed.empty())
        throw SolverError("no one-to-one map was found that has these pins in their places", ElementKind::vertices,
                          values_at(pins.vertices, missed));
    // The size of the map at the pins is the size that faces should have.
    const double factor = scale_to_size(vertices_, triangles_, image_area(triangles_, form.points));
    form.points *= factor;
    form.scale *= factor;
    form.extent *= factor;
    FlatSurface flat = view(form);
    flat.held = pins.vertices;
    make_even(flat, even, form.extent, context, effort_at_pins, pattern_.get());
}

}  // namespace koebe
