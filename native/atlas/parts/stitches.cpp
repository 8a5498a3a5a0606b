#include "parts/stitches.h"

#include "core/complex_places.h"
#include "core/connectivity.h"
#include "cut/disjoint_sets.h"
#include "even/even_map.h"
#include "parts/carried_parts.h"
#include "parts/part_borders.h"
#include "parts/tension.h"
#include "parts/through_cuts.h"
#include "planar/rigid_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

namespace koebe {
namespace {

constexpr EvenEffort stitch_effort{6, 4, 60, 4};
constexpr int most_stitches_tried = 12;
constexpr std::size_t most_places = 32;  // along a border, at which a stretch may begin or end
constexpr double most_of_ring = 0.8;     // of a closed border
constexpr double dense = 4.0;            // times its own area: such a face wastes texels

/// The edges of a stretch, named by their vertices in the whole.
using BorderStretch = std::vector<EdgeEnds>;

struct Stitch {
    std::vector<BorderStretch> stretches;  ///< one, or one and its mirror image
    double saved = 0.0;                    ///< what the cut and the island cost
    double forecast = 0.0;                 ///< of what is won
};

/// What the islands of a layout look like.
struct Look {
    double area = 0.0, length = 0.0;  ///< in the plane, and of all loops
    double wasted = 0.0;              ///< area of faces whose texels are much too dense

    /// The area, less the less it is like a disk: 4 pi A^2 / L^2.
    double compact_area() const { return 4.0 * std::numbers::pi * std::pow(area / length, 2); }
};

Look look_of(const FlatPart& flat)
{
    Look look;
    const VectorXd areas = face_areas(flat.vertices, flat.surface.triangles);
    for (Index f = 0; f < static_cast<Index>(areas.size()); ++f) {
        const double area = signed_area(flat.points, flat.surface.triangles, f);
        look.area += area;
        if (area > dense * areas[f]) look.wasted += area;
    }
    for (const VertexLoop& loop : flat.surface.loops)
        for (std::size_t i = 0; i < loop.size(); ++i)
            look.length += (flat.points.row(loop[i]) - flat.points.row(loop[(i + 1) % loop.size()])).norm();
    return look;
}

/// What a layout costs, in energy, beside its cuts and islands.
struct LayoutState {
    double energy = 0.0, wasted = 0.0, compactness = 0.0;  ///< wasted: share of the area

    LayoutState(const std::vector<FlatPart>& parts, double even)
    {
        double area = 0.0;
        for (const FlatPart& flat : parts) {
            const Look look = look_of(flat);
            energy += forces_in(flat, even).energy.sum();
            area += look.area;
            wasted += look.wasted;
            compactness += look.compact_area();
        }
        wasted /= area;
        compactness /= area;
    }
};

/// Sums along a border up to each of its places, so that those of a stretch are differences.
struct BorderSums {
    std::vector<RigidFit> fit;  ///< of both sides in the plane; one more than there are places
    std::vector<double> cost{0.0}, length{0.0};
    std::vector<int> refused{0};  ///< edges in the middle of stretches that did not pay

    RigidFit fit_of(std::size_t from, std::size_t to) const { return fit[to + 1] - fit[from]; }
};

double edge_length(const FlatPart& part, Index h)
{
    const Triangles& triangles = part.surface.triangles;
    return (part.vertices.row(origin(triangles, h)) - part.vertices.row(target(triangles, h))).norm();
}

class StitchSearch {
public:
    StitchSearch(const std::vector<FlatPart>& parts, const ThroughPrice& price, const std::set<EdgeEnds>& refused)
        : parts_(parts), price_(price), refused_(refused), borders_(parts)
    {
        for (const FlatPart& part : parts) {
            looks_.push_back(look_of(part));
            area_ += looks_.back().area;
        }
    }

    std::optional<Stitch> best() const
    {
        std::optional<Stitch> best;
        for (const PartBorder& border : borders_.all())
            if (auto stitch = best_along(border); stitch && (!best || stitch->forecast > best->forecast))
                best = std::move(stitch);
        return best;
    }

private:
    /// A stretch, between two places of a border.
    struct Window {
        std::size_t from = 0, to = 0;
    };

    double seen_length(const FlatPart& part, Index h) const
    {
        const Index a = origin(part.surface.triangles, h), b = target(part.surface.triangles, h);
        return price_of_edge(part.shown, a, b) * edge_length(part, h);
    }

    /// A closed border begins where it is least seen.
    PartBorder opened(PartBorder border) const
    {
        if (!border.is_ring) return border;
        const FlatPart& part = parts_[border.first];
        const auto least = std::ranges::min_element(
            border.of_first, {}, [&](Index h) { return seen_length(part, h) / edge_length(part, h); });
        const auto at = least - border.of_first.begin();
        std::rotate(border.of_first.begin(), border.of_first.begin() + at, border.of_first.end());
        std::rotate(border.of_second.begin(), border.of_second.begin() + at, border.of_second.end());
        return border;
    }

    BorderSums sums_along(const PartBorder& border) const
    {
        const FlatPart &first = parts_[border.first], &second = parts_[border.second];
        BorderSums sums;
        for (const Index h : border.of_first) {
            sums.cost.push_back(sums.cost.back() + seen_length(first, h));
            sums.length.push_back(sums.length.back() + edge_length(first, h));
            sums.refused.push_back(sums.refused.back() + (refused_.contains(borders_.name({border.first, h})) ? 1 : 0));
        }
        sums.fit.emplace_back();
        for (std::size_t i = 0; i <= border.edges(); ++i) {
            const auto [v, w] = borders_.vertices_at(border, i);
            const double beside = sums.length[std::min(i + 1, border.edges())] - sums.length[i > 0 ? i - 1 : 0];
            sums.fit.push_back(sums.fit.back());
            sums.fit.back().add(complex_at(first.points, v), complex_at(second.points, w), beside);
        }
        return sums;
    }

    /// For each place of a border its mirror image on the same border; empty if it has none.
    std::vector<std::size_t> mirrored_places(const PartBorder& border) const
    {
        const FlatPart& first = parts_[border.first];
        std::vector<std::size_t> mirror;
        if (first.image.empty()) return mirror;
        std::vector<Index> names, images;
        for (std::size_t i = 0; i <= border.edges(); ++i) {
            const Index v = borders_.vertices_at(border, i).first;
            names.push_back(first.original[v]);
            images.push_back(first.image[v]);
        }
        std::map<Index, std::size_t> place;
        for (std::size_t i = 0; i < names.size(); ++i) place.emplace(names[i], i);
        for (const Index image : images) {
            const auto found = place.find(image);
            if (found == place.end()) return {};
            mirror.push_back(found->second);
        }
        return mirror;
    }

    /// The stretch with its mirror image, if both meet.
    static std::optional<Window> symmetric(Window window, const std::vector<std::size_t>& mirror)
    {
        if (mirror.empty()) return window;
        const auto [low, high] = std::minmax(mirror[window.from], mirror[window.to]);
        if (low > window.to || high < window.from) return {};
        return Window{std::min(window.from, low), std::max(window.to, high)};
    }

    /// What a stretch saves: its cut, and one island where the neck is as wide as the smaller part.
    double saved_by(const PartBorder& border, const BorderSums& sums, Window window) const
    {
        if (border.first == border.second)
            return stitch_saving({price_.length, {}}, sums.cost[window.to] - sums.cost[window.from], 0.0);
        const double small = std::sqrt(std::min(looks_[border.first].area, looks_[border.second].area));
        return stitch_saving(price_, sums.cost[window.to] - sums.cost[window.from],
                             (sums.length[window.to] - sums.length[window.from]) / small);
    }

    /// What a stretch wins: what it saves, less what bends and what compactness is lost.
    double won_by(const PartBorder& border, const BorderSums& sums, Window window) const
    {
        const RigidFit fit = sums.fit_of(window.from, window.to);
        if (border.first == border.second) return saved_by(border, sums, window) - tuning::bent_border * fit.distance();
        const Look &a = looks_[border.first], &b = looks_[border.second];
        const Look both{a.area + b.area,
                        a.length + b.length - 2.0 * (sums.length[window.to] - sums.length[window.from])};
        const double loss = roundness_loss((a.compact_area() + b.compact_area()) / area_, both.compact_area() / area_);
        return saved_by(border, sums, window) - loss - tuning::bent_border * fit.misfit();
    }

    std::optional<Stitch> best_along(const PartBorder& closed) const
    {
        if (is_true_to_size(parts_[closed.first]) || is_true_to_size(parts_[closed.second])) return {};
        const PartBorder border = opened(closed);
        const BorderSums sums = sums_along(border);
        const std::vector<std::size_t> mirror = mirrored_places(border);
        const std::size_t count = border.edges(), step = std::max<std::size_t>(1, count / most_places);
        Window best;
        double most = 0.0;
        for (std::size_t i = 0; i < count; i += step)
            for (std::size_t j = i; j < count;) {
                j = std::min(count, j + step);
                const auto window = symmetric({i, j}, mirror);
                if (!window || sums.refused[window->to] > sums.refused[window->from]) continue;
                const double length = sums.length[window->to] - sums.length[window->from];
                if (border.is_ring && length > most_of_ring * sums.length.back()) continue;
                if (const double won = won_by(border, sums, *window); won > most) {
                    most = won;
                    best = *window;
                }
            }
        if (!(most > 0.0)) return {};
        return with_image(border, best, {{}, saved_by(border, sums, best), most});
    }

    /// The stitch along a stretch, and along its mirror image where that is another one.
    std::optional<Stitch> with_image(const PartBorder& border, Window window, Stitch stitch) const
    {
        BorderStretch own, image;
        for (std::size_t i = window.from; i < window.to; ++i) {
            const PartEdge edge{border.first, border.of_first[i]};
            own.push_back(borders_.name(edge));
            if (!parts_[border.first].image.empty()) image.push_back(borders_.image(edge));
        }
        const std::set<EdgeEnds> names(own.begin(), own.end());
        const auto common = std::ranges::count_if(image, [&](const EdgeEnds& edge) { return names.contains(edge); });
        if (common > 0 && common < std::ssize(image)) return {};
        stitch.stretches.push_back(std::move(own));
        if (image.empty() || common > 0) return stitch;
        if (!std::ranges::all_of(image, [&](const EdgeEnds& edge) { return borders_.find(edge); })) return {};
        stitch.stretches.push_back(std::move(image));
        stitch.saved *= 2.0;
        stitch.forecast *= 2.0;
        return stitch;
    }

    const std::vector<FlatPart>& parts_;
    ThroughPrice price_;
    const std::set<EdgeEnds>& refused_;
    PartBorders borders_;
    std::vector<Look> looks_;
    double area_ = 0.0;
};

/// Two parts beside each other, the second moved onto the first, with the vertices of both.
FlatPart beside(const FlatPart& first, const FlatPart& second, const RigidFit& fit)
{
    FlatPart both = first;
    const auto append = [](auto& to, const auto& more) { to.insert(to.end(), more.begin(), more.end()); };
    append(both.faces, second.faces);
    append(both.polygon, second.polygon);
    append(both.sizes, second.sizes);
    append(both.original, second.original);
    append(both.image, second.image);
    append(both.held, second.held);
    append(both.shown, second.shown);
    both.slit += second.slit;  // lengths are summed over all parts
    both.dart_length += second.dart_length;
    const Index count = first.surface.vertex_count, more = second.surface.vertex_count;
    both.vertices.conservativeResize(count + more, 3);
    both.vertices.bottomRows(more) = second.vertices;
    both.points.conservativeResize(count + more, 2);
    for (Index v = 0; v < more; ++v) put_complex(both.points, count + v, fit.moved(complex_at(second.points, v)));
    return both;
}

/// Vertices where a slit ends: the edges before and after them are one edge of the whole.
std::vector<Index> tips_of(const FlatPart& part)
{
    std::vector<Index> tips;
    for (const VertexLoop& loop : part.surface.loops)
        for (std::size_t i = 0; i < loop.size(); ++i)
            if (part.original[loop[(i + loop.size() - 1) % loop.size()]] == part.original[loop[(i + 1) % loop.size()]])
                tips.push_back(loop[i]);
    return tips;
}

/// A part with pairs of its boundary's half-edges joined. Their vertices lie in the middle of their places.
/// @return nothing if that is no surface
std::optional<FlatPart> joined(FlatPart part, const Triangles& apart,
                               const std::vector<std::pair<Index, Index>>& halfedges)
{
    const auto count = static_cast<Index>(part.vertices.rows());
    DisjointSets same(static_cast<std::size_t>(count));
    for (const auto& [h, g] : halfedges) {
        same.join(origin(apart, h), target(apart, g));
        same.join(target(apart, h), origin(apart, g));
    }
    std::vector<Index> source, number(static_cast<std::size_t>(count), -1), copies;
    PlanarPoints sums = PlanarPoints::Zero(count, 2);
    for (Index v = 0; v < count; ++v) {
        Index& own = number[same.find(v)];
        if (own < 0) {
            own = static_cast<Index>(source.size());
            source.push_back(v);
            copies.push_back(0);
        }
        copies[own] += 1;
        sums.row(own) += part.points.row(v);
    }
    for (Index v = 0; v < count; ++v) number[v] = number[same.find(v)];
    for (std::size_t v = 0; v < source.size(); ++v)
        part.points.row(source[v]) = sums.row(static_cast<Index>(v)) / copies[v];
    Triangles triangles = apart;
    for (Index& corner : triangles.reshaped()) corner = number[corner];
    std::vector<Index> order(part.faces.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, [&](Index f) { return part.faces[f]; });
    auto piece = opened_piece(part, order, triangles(order, Eigen::all), source);
    if (!piece) return {};
    piece->tips = tips_of(*piece);
    piece->slit = part.slit;
    piece->dart_length = part.dart_length;
    return piece;
}

/// Two parts as one, joined along pairs of half-edges, one of each.
std::optional<FlatPart> joined(const FlatPart& first, const FlatPart& second,
                               std::vector<std::pair<Index, Index>> halfedges)
{
    RigidFit fit;
    for (auto& [h, g] : halfedges) {
        const Triangles &own = first.surface.triangles, &other = second.surface.triangles;
        fit.add(complex_at(first.points, origin(own, h)), complex_at(second.points, target(other, g)));
        fit.add(complex_at(first.points, target(own, h)), complex_at(second.points, origin(other, g)));
        g += static_cast<Index>(own.size());
    }
    Triangles triangles(first.surface.triangles.rows() + second.surface.triangles.rows(), 3);
    triangles << first.surface.triangles, second.surface.triangles.array() + first.surface.vertex_count;
    return joined(beside(first, second, fit), triangles, halfedges);
}

/// Joins the sides of a stretch: of two parts, or of a slit of one part.
/// @param changed (parts) kept in step @return whether that is a surface
bool join_along(const BorderStretch& stretch, std::vector<FlatPart>& parts, std::vector<char>& changed)
{
    const PartBorders borders(parts);
    std::vector<std::pair<Index, Index>> halfedges;
    std::pair<std::size_t, std::size_t> own;
    double length = 0.0;
    for (const EdgeEnds& edge : stretch) {
        const std::vector<PartEdge>* both = borders.find(edge);
        if (!both) return false;
        const std::pair found((*both)[0].part, (*both)[1].part);
        if (halfedges.empty()) own = found;
        if (found != own) return false;
        halfedges.emplace_back((*both)[0].halfedge, (*both)[1].halfedge);
        length += edge_length(parts[own.first], halfedges.back().first);
    }
    const auto [first, second] = own;
    const bool is_slit = first == second;
    auto piece = is_slit ? joined(parts[first], parts[first].surface.triangles, halfedges)
                         : joined(parts[first], parts[second], halfedges);
    if (!piece) return false;
    // The rest of the border of two parts is a slit now.
    if (!is_slit)
        for (const PartBorder& border : borders.all())
            if (std::minmax(border.first, border.second) == std::minmax(first, second))
                for (const Index h : border.of_first) piece->slit += edge_length(parts[border.first], h);
    const double of_slit = std::min(length, piece->slit);
    piece->slit -= of_slit;
    piece->dart_length = std::max(0.0, piece->dart_length - (length - of_slit));
    parts[first] = std::move(*piece);
    changed[first] = 1;
    if (is_slit) return true;
    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(second));
    changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(second));
    return true;
}

/// The parts after a stitch, relaxed; nothing if they cannot be one to one.
std::optional<std::vector<FlatPart>> stitched(std::vector<FlatPart> parts, const Stitch& stitch, double even,
                                              ExecutionContext& context)
{
    std::vector<char> changed(parts.size(), 0);
    for (const BorderStretch& stretch : stitch.stretches)
        if (!join_along(stretch, parts, changed)) return {};
    for (std::size_t k = 0; k < parts.size(); ++k) {
        if (!changed[k]) continue;
        if (!lies_one_to_one(parts[k], parts[k].points)) start_by_itself({}, parts[k], context);
        std::vector<RoundLoop> none;
        if (!make_even(flat_surface(parts[k], none), even, packed_side, context, stitch_effort).moved ||
            !survives_storing(parts[k]))
            return {};
    }
    return parts;
}

}  // namespace

bool stitch_parts(std::vector<HeldPart>& held, double even, const ThroughPrice& price, ExecutionContext& context)
{
    std::vector<FlatPart> parts;
    for (HeldPart& part : held) parts.push_back(std::move(part.flat));
    LayoutState now(parts, even);
    std::set<EdgeEnds> refused;
    bool any = false;
    for (int tried = 0; tried < most_stitches_tried; ++tried) {
        context.checkpoint();
        const auto stitch = StitchSearch(parts, price, refused).best();
        if (!stitch) break;
        auto trial = stitched(parts, *stitch, even, context);
        bool pays = false;
        if (trial) {
            const LayoutState after(*trial, even);
            const double cost = after.energy - now.energy + roundness_loss(now.compactness, after.compactness);
            pays = cost < stitch->saved && after.wasted < now.wasted + tuning::wasted_texels;
            if (pays) now = after;
        }
        if (pays) {
            parts = std::move(*trial);
            any = true;
        } else {
            for (const BorderStretch& stretch : stitch->stretches) refused.insert(stretch[stretch.size() / 2]);
        }
    }
    held.clear();
    for (FlatPart& part : parts) held.push_back({std::move(part), {}});
    return any;
}

}  // namespace koebe
