#include "even/pinned_map.h"

#include "core/complex_places.h"
#include "core/errors.h"
#include "core/numbering.h"
#include "core/sort_unique.h"
#include "planar/boundary_crossings.h"
#include "planar/planar_predicates.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace koebe {
namespace {

constexpr double first_weight = 10.0, last_weight = 1e9, stiffer = 10.0;  // of springs, see PlacePull
constexpr EvenEffort effort_of_a_pull{8, 4, 8};
constexpr double is_nearer = 0.99;   // the largest distance must fall to this,
constexpr int most_stalls = 3;       // or the pull ends after so many rounds at the last weight
constexpr int most_rounds = 60;      // of stiffer springs
constexpr double kept_area = 0.25;   // of a face, when a pin goes the last step to its place
constexpr double drawn_edge = 1e-7;  // over the extent, as in even_map.cpp

std::vector<Index> numbers_of_pins(const Pins& pins, Eigen::Index vertices)
{
    std::vector<Index> pin_of(static_cast<std::size_t>(vertices), -1);
    for (std::size_t i = 0; i < pins.vertices.size(); ++i) pin_of[pins.vertices[i]] = static_cast<Index>(i);
    return pin_of;
}

Complex place_of(const Pins& pins, std::size_t i) { return complex_at(pins.places, static_cast<Eigen::Index>(i)); }

class PinPull {
public:
    PinPull(const FlatSurface& surface, const Pins& pins, double extent)
        : flat_(surface), pins_(pins), pin_of_(numbers_of_pins(pins, surface.points.rows()))
    {
        if (!apart(surface.points)) shortest_ = drawn_edge * extent;
    }

    /// The largest distance of a pin from its place.
    double farthest() const
    {
        double most = 0.0;
        for (std::size_t i = 0; i < pins_.vertices.size(); ++i)
            most = std::max(most, (flat_.points.row(pins_.vertices[i]) - place(i)).norm());
        return most;
    }

    /// Puts all pins into their places, if every face stays upright, and no loops cross. @return whether it did
    bool put()
    {
        PlanarPoints points = flat_.points;
        for (std::size_t i = 0; i < pins_.vertices.size(); ++i) points.row(pins_.vertices[i]) = place(i);
        if (!in_the_way(points).empty() || !apart(points)) return false;
        flat_.points = std::move(points);
        return true;
    }

    /// The pins that turn a face over when they go to their places; all that are away from theirs if no pin does.
    std::vector<Index> missed() const
    {
        PlanarPoints points = flat_.points;
        for (std::size_t i = 0; i < pins_.vertices.size(); ++i) points.row(pins_.vertices[i]) = place(i);
        std::vector<Index> found = in_the_way(points);
        if (!found.empty()) return found;
        const double far = 0.1 * farthest();
        for (std::size_t i = 0; i < pins_.vertices.size(); ++i)
            if ((flat_.points.row(pins_.vertices[i]) - place(i)).norm() >= far) found.push_back(static_cast<Index>(i));
        return found;
    }

private:
    Eigen::RowVector2d place(std::size_t i) const { return pins_.places.row(static_cast<Eigen::Index>(i)); }

    /// The pins of faces that lose most of their area, or are turned over, at these points.
    std::vector<Index> in_the_way(const PlanarPoints& points) const
    {
        std::vector<char> bad(pins_.vertices.size(), 0);
        for (Eigen::Index f = 0; f < flat_.triangles.rows(); ++f) {
            const auto face = flat_.triangles.row(f);
            if (std::ranges::none_of(face, [&](Index v) { return pin_of_[v] >= 0; })) continue;
            if (signed_area(points, flat_.triangles, f) > kept_area * signed_area(flat_.points, flat_.triangles, f))
                continue;
            for (const Index v : face)
                if (pin_of_[v] >= 0) bad[pin_of_[v]] = 1;
        }
        std::vector<Index> found;
        for (std::size_t i = 0; i < bad.size(); ++i)
            if (bad[i]) found.push_back(static_cast<Index>(i));
        return found;
    }

    bool apart(const PlanarPoints& points) const
    {
        return !loops_cross(flat_.loops, points, shortest_) && turned_loops(flat_.loops, points, shortest_).empty();
    }

    FlatSurface flat_;
    const Pins& pins_;
    std::vector<Index> pin_of_;  // (V) -1: no pin
    double shortest_ = 0.0;      // edges that count
};

void require_distinct(const Pins& pins)
{
    std::vector<Index> order = numbers_below(pins.vertices.size());
    const auto pair = [&](Index i) { return std::pair(pins.places(i, 0), pins.places(i, 1)); };
    std::ranges::sort(order, {}, pair);
    for (std::size_t i = 1; i < order.size(); ++i)
        if (pair(order[i]) == pair(order[i - 1]))
            throw InputError("two pins are at one place", ElementKind::vertices,
                             {pins.vertices[order[i - 1]], pins.vertices[order[i]]});
    std::ranges::sort(order, {}, [&](Index i) { return pins.vertices[i]; });
    for (std::size_t i = 1; i < order.size(); ++i)
        if (pins.vertices[order[i]] == pins.vertices[order[i - 1]])
            throw InputError("a vertex is pinned twice", ElementKind::vertices, {pins.vertices[order[i]]});
}

}  // namespace

void require_pins(const Pins& pins, const Triangles& triangles, Eigen::Index vertices)
{
    if (pins.count() != static_cast<Eigen::Index>(pins.vertices.size()) || !pins.places.allFinite())
        throw InputError("each pin needs a finite place");
    for (const Index v : pins.vertices)
        if (v < 0 || v >= vertices) throw InputError("a pin is no vertex", ElementKind::vertices, {v});
    require_distinct(pins);
    // A face with three pins has its form: it must be upright.
    const std::vector<Index> pin_of = numbers_of_pins(pins, vertices);
    std::vector<Index> turned;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const auto face = triangles.row(f);
        if (std::ranges::any_of(face, [&](Index v) { return pin_of[v] < 0; })) continue;
        const auto place = [&](int k) { return place_of(pins, pin_of[face[k]]); };
        if (!(cross(place(1) - place(0), place(2) - place(0)) > 0.0))
            turned.insert(turned.end(), face.begin(), face.end());
    }
    sort_unique(turned);
    if (!turned.empty()) throw InputError("pins turn faces over", ElementKind::vertices, turned);
}

PinPlacement placement_at_pins(const Pins& pins, const PlanarPoints& points)
{
    const std::size_t count = pins.vertices.size();
    Complex from, to;  // the middles
    for (std::size_t i = 0; i < count; ++i) {
        from += complex_at(points, pins.vertices[i]) / static_cast<double>(count);
        to += place_of(pins, i) / static_cast<double>(count);
    }
    double spread_from = 0.0, spread_to = 0.0;
    Complex turn;
    for (std::size_t i = 0; i < count; ++i) {
        const Complex arm = complex_at(points, pins.vertices[i]) - from, wanted = place_of(pins, i) - to;
        spread_from += std::norm(arm);
        spread_to += std::norm(wanted);
        turn += std::conj(arm) * wanted;
    }
    PinPlacement placement;
    if (count > 1) placement.factor = std::sqrt(spread_to / spread_from);
    if (count > 1 && std::abs(turn) > 0.0) placement.factor *= turn / std::abs(turn);
    placement.shift = to - placement.factor * from;
    return placement;
}

std::vector<Index> draw_to_pins(const FlatSurface& surface, const Pins& pins, double even, double extent,
                                ExecutionContext& context, NewtonPattern* pattern)
{
    PinPull pull(surface, pins, extent);
    FlatSurface drawn = surface;
    drawn.pull = {pins.vertices, pins.places, first_weight};
    double before = std::numeric_limits<double>::infinity();
    int stalls = 0;
    for (int round = 0; round < most_rounds && stalls < most_stalls; ++round) {
        if (pull.put()) return {};
        make_even(drawn, even, extent, context, effort_of_a_pull, pattern);
        const double now = pull.farthest();
        if (drawn.pull.weight >= last_weight) stalls = now < is_nearer * before ? 0 : stalls + 1;
        before = now;
        drawn.pull.weight = std::min(drawn.pull.weight * stiffer, last_weight);
    }
    return pull.put() ? std::vector<Index>{} : pull.missed();
}

}  // namespace koebe
