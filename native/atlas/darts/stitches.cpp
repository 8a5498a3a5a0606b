#include "darts/stitches.h"

#include "core/complex_places.h"
#include "core/connectivity.h"
#include "core/numbering.h"
#include "cut/disjoint_sets.h"
#include "darts/own_start.h"
#include "darts/stitch_search.h"
#include "darts/tension.h"
#include "darts/through_cuts.h"
#include "even/even_map.h"
#include "execution/profile.h"
#include "flat/part_borders.h"
#include "flat/part_look.h"
#include "planar/rigid_fit.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

namespace koebe {
namespace {

constexpr EvenEffort stitch_effort{6, 4, 60, 4};
constexpr int most_stitches_tried = 12;

/// What a layout costs, in energy, beside its cuts and islands.
struct LayoutState {
    double energy = 0.0, wasted = 0.0, compactness = 0.0;  ///< wasted: share of the area

    LayoutState(const std::vector<FlatPart>& parts, double even)
    {
        double area = 0.0;
        for (const FlatPart& flat : parts) {
            const PartLook look = look_of(flat);
            energy += forces_in(flat, even).energy.sum();
            area += look.area;
            wasted += look.wasted;
            compactness += look.compact_area();
        }
        wasted /= area;
        compactness /= area;
    }
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
    // One vertex for all copies, at the mean of their places.
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
    // Faces ascend again, as in all parts.
    Triangles triangles = apart;
    for (Index& corner : triangles.reshaped()) corner = number[corner];
    std::vector<Index> order = numbers_below(part.faces.size());
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
                               const std::vector<std::pair<Index, Index>>& halfedges)
{
    RigidFit fit;
    std::vector<std::pair<Index, Index>> beside_each_other;
    for (const auto& [h, g] : halfedges) {
        const Triangles &own = first.surface.triangles, &other = second.surface.triangles;
        fit.add(complex_at(first.points, origin(own, h)), complex_at(second.points, target(other, g)));
        fit.add(complex_at(first.points, target(own, h)), complex_at(second.points, origin(other, g)));
        beside_each_other.emplace_back(h, g + static_cast<Index>(own.size()));
    }
    Triangles triangles(first.surface.triangles.rows() + second.surface.triangles.rows(), 3);
    triangles << first.surface.triangles, second.surface.triangles.array() + first.surface.vertex_count;
    return joined(beside(first, second, fit), triangles, beside_each_other);
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
        length += length_on_part(parts[own.first], halfedges.back().first);
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
                for (const Index h : border.of_first) piece->slit += length_on_part(parts[border.first], h);
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

/// The parts after a stitch, relaxed; nothing if they cannot be one to one. @param work counted on
std::optional<std::vector<FlatPart>> stitched(std::vector<FlatPart> parts, const Stitch& stitch, double even,
                                              double& work, ExecutionContext& context)
{
    std::vector<char> changed(parts.size(), 0);
    for (const BorderStretch& stretch : stitch.stretches)
        if (!join_along(stretch, parts, changed)) return {};
    for (std::size_t k = 0; k < parts.size(); ++k) {
        if (!changed[k]) continue;
        if (!lies_one_to_one(parts[k], parts[k].points)) start_by_itself({}, parts[k], context);
        std::vector<RoundLoop> none;
        const EvenMap relaxed = make_even(flat_surface(parts[k], none), even, packed_side, context, stitch_effort);
        work += static_cast<double>(relaxed.iterations) * static_cast<double>(parts[k].faces.size());
        if (!relaxed.moved || !survives_storing(parts[k])) return {};
    }
    return parts;
}

}  // namespace

bool stitch_parts(std::vector<HeldPart>& held, double even, const ThroughPrice& price, ExecutionContext& context)
{
    const ProfiledStage profiled("stitches");
    std::vector<FlatPart> parts;
    for (HeldPart& part : held) parts.push_back(std::move(part.flat));
    LayoutState now(parts, even);
    std::set<EdgeEnds> refused;
    double faces = 0.0, work = 0.0;
    for (const FlatPart& part : parts) faces += static_cast<double>(part.faces.size());
    bool any = false;
    for (int tried = 0; tried < most_stitches_tried && work < most_trial_work * faces; ++tried) {
        context.checkpoint();
        const auto stitch = best_stitch(parts, price, refused);
        if (!stitch) break;
        auto trial = stitched(parts, *stitch, even, work, context);
        // It pays if E' - E + roundness_loss(C, C') < what its cuts and islands cost, and no more texels are wasted.
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
