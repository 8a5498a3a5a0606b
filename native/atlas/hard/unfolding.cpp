#include "hard/unfolding.h"

#include "cost/tolerances.h"
#include "cost/tuning.h"
#include "flat/regions.h"
#include "hard/chart_islands.h"
#include "hard/grid_parts.h"
#include "hard/hard_room.h"
#include "planar/rigid_fit.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace koebe {
namespace {

constexpr double least_border = 0.12;     // of a chart's boundary: a shorter common border is not worth joining
constexpr double strip_border = 0.4;      // of the boundary of a chart, with one so many times larger:
constexpr double strip_plate = 5.0;       // it is a strip of that, such as a chamfer, and joined with it first
constexpr std::size_t most_tips = 64;     // of one chart,
constexpr std::size_t most_charts = 300;  // of a surface: else it is smooth, or rough
constexpr std::size_t cone_tips = 2;      // of a chart of a hard surface
constexpr double least_hard = 0.25;       // of the area: hold so much of a hard surface,
constexpr double large_plate = 0.1;       // or one plate: the flat sides of a figure's trunk are smaller

constexpr double side_of_nut = 1.80;  // longest island, in roots of its surface's area: the six sides of a nut
constexpr int most_border_fits = 4;   // of a border under noise
constexpr double whole_mesh = 0.999;  // of the area of all surfaces: this one is alone

/// The longest island, in roots of the area of all surfaces. @param area of this surface
double longest_island(double area, const UnfoldOptions& options)
{
    if (!options.roomy) return std::numeric_limits<double>::infinity();
    return options.compact ? tuning::longest_hard : std::max(tuning::longest_hard, side_of_nut * std::sqrt(area));
}

class Unfolding : public ChartIslands {
public:
    Unfolding(const CutSurface& surface, FlatCharts charts, const UnfoldOptions& options)
        : ChartIslands(surface, std::move(charts)), longest_(longest_island(surface.areas.sum(), options))
    {
    }

    /// The area of charts that are not small, without single faces in the planes of which no other face lies. An
    /// animal of few faces has charts with such faces only. A chart between planar regions counts as a whole: the side
    /// of a cone consists of single faces.
    double hard_area(double least) const
    {
        const auto is_planar = [&](Index f) { return charts_.plane[f] > alone * surface_.areas[f]; };
        double sum = 0.0;
        for (const std::vector<Index>& faces : islands_) {
            const double area = surface_.areas(faces).sum();
            if (!(area >= least)) continue;
            double planar = 0.0, outline = 0.0, at_planar = 0.0;
            for (const Index f : faces) {
                if (is_planar(f)) planar += surface_.areas[f];
                for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                    if (charts_.net.twin[h] != no_twin || charts_.crease[h] != bent_edge) continue;
                    outline += surface_.lengths[h];
                    if (is_planar(face_of(twin(h)))) at_planar += surface_.lengths[h];
                }
            }
            sum += at_planar > tolerance::majority * outline ? area : planar;
        }
        return sum;
    }

    /// Of a round body, such as a ball with a base, only the plates stay, if one of them is large.
    /// @return whether there are any
    bool keep_plates()
    {
        double largest = 0.0;
        for (std::size_t k = 0; k < islands_.size(); ++k) {
            std::vector<Index> plate;
            std::ranges::copy_if(islands_[k], std::back_inserter(plate), [&](Index f) { return charts_.plate[f]; });
            if (const double flat = surface_.areas(plate).sum();
                flat > tolerance::majority * surface_.areas(islands_[k]).sum()) {
                largest = std::max(largest, flat);
                continue;
            }
            for (const Index f : islands_[k]) chart_[f] = -1;
            charts_.rest.insert(charts_.rest.end(), islands_[k].begin(), islands_[k].end());
            islands_[k].clear();
        }
        return largest >= large_plate * surface_.areas.sum();
    }

    /// @param smooth_only not over creases
    void join_charts(bool smooth_only, ExecutionContext& context)
    {
        for (const Index h : borders()) {
            context.checkpoint();
            if (smooth_only && charts_.crease[h] == bent_edge) continue;
            const Index a = island_of(h), b = island_of(twin(h));
            if (a == b) continue;
            islands_[a].size() < islands_[b].size() ? join(twin(h)) : join(h);
        }
    }

    double noise() const { return charts_.noise; }

    double cut_length() const
    {
        double length = 0.0;
        for (Index h = 0; h < halfedges(); ++h)
            if (twin(h) > h && charts_.net.twin[h] == no_twin) length += surface_.lengths[h];
        return length;
    }

    std::vector<Index> rest()
    {
        std::ranges::sort(charts_.rest);
        return charts_.rest;
    }

    std::vector<FlatPart> parts()
    {
        const auto is_cut = [&](Index h) { return charts_.net.twin[h] == no_twin && chart_[face_of(h)] >= 0; };
        for (const Index h : charts_.slits)
            if (is_cut(h)) parts_[island_of(h)].slit += surface_.lengths[h];
        for (const Index h : charts_.darts)
            if (is_cut(h)) parts_[island_of(h)].dart_length += surface_.lengths[h];
        std::vector<FlatPart> found;
        for (std::size_t k = 0; k < parts_.size(); ++k)
            if (!islands_[k].empty()) found.push_back(std::move(parts_[k]));
        return found;
    }

    /// The parts, cut between planar regions where the pieces need less room in the square; empty: nowhere.
    std::vector<FlatPart> roomier(const std::vector<FlatPart>& parts, ExecutionContext& context) const
    {
        return cut_between_planes(surface_, charts_, parts, context);
    }

private:
    /// The motion that brings the face across a crease to the crease's place.
    PlaneMotion motion_to(Index h) const
    {
        const Index t = twin(h);
        const Complex from = charts_.at[next_halfedge(t)] - charts_.at[t],
                      to = charts_.at[h] - charts_.at[next_halfedge(h)];
        const Complex turn = to / from / std::abs(to / from);
        return {turn, charts_.at[next_halfedge(h)] - turn * charts_.at[t]};
    }

    /// The motion that brings the chart across a border to its place at one of its edges. Under noise to the place
    /// nearest to all edges that then meet.
    PlaneMotion motion_over(const std::vector<Index>& border, Index crease) const
    {
        PlaneMotion motion = motion_to(crease);
        for (int round = 0; charts_.noise > 0.0 && round < most_border_fits; ++round) {
            RigidFit fit;
            for (const Index h : border) {
                if (!meets(h, motion)) continue;
                fit.add(charts_.at[next_halfedge(h)], charts_.at[twin(h)], surface_.lengths[h]);
                fit.add(charts_.at[h], charts_.at[next_halfedge(twin(h))], surface_.lengths[h]);
            }
            if (fit.weight > 0.0) motion = {fit.turn(), fit.moved(0.0)};
        }
        return motion;
    }

    bool meets(Index h, const PlaneMotion& motion) const
    {
        const Index t = twin(h);
        return same(motion(charts_.at[t]), charts_.at[next_halfedge(h)]) &&
               same(motion(charts_.at[next_halfedge(t)]), charts_.at[h]);
    }

    /// For each pair of charts the crease at which they are best joined, if their straight common border is long
    /// enough. Smooth borders and those of strips first, then the longest.
    std::vector<Index> borders() const
    {
        // Borders of each pair of charts, and the whole boundary of each chart.
        std::map<std::pair<Index, Index>, std::vector<Index>> common;
        std::vector<double> boundary(islands_.size(), 0.0), area(boundary);
        for (std::size_t k = 0; k < area.size(); ++k) area[k] = surface_.areas(islands_[k]).sum();
        for (Index h = 0; h < halfedges(); ++h) {
            if (charts_.net.twin[h] != no_twin) continue;
            const Index a = chart_[face_of(h)];
            if (a < 0) continue;
            boundary[a] += surface_.lengths[h];
            if (twin(h) == no_twin) continue;
            if (const Index b = chart_[face_of(twin(h))]; a < b) common[{a, b}].push_back(h);
        }
        // At the longest edge of a border the charts are joined: what then lies in one place counts as common.
        std::vector<std::tuple<char, double, Index>> found;
        for (const auto& [charts, halfedges] : common) {
            const Index longest =
                *std::ranges::max_element(halfedges, {}, [&](Index h) { return surface_.lengths[h]; });
            const PlaneMotion motion = motion_over(halfedges, longest);
            double length = 0.0, price = 0.0;
            for (const Index h : halfedges)
                if (meets(h, motion)) {
                    length += surface_.lengths[h];
                    price += charts_.net.length[h];
                }
            const auto [a, b] = charts;
            if (length < least_border * std::min(boundary[a], boundary[b])) continue;
            const auto [smaller, larger] = area[a] < area[b] ? std::pair(a, b) : std::pair(b, a);
            const bool is_strip =
                length >= strip_border * boundary[smaller] && area[larger] > strip_plate * area[smaller];
            found.emplace_back(is_strip ? 0 : charts_.crease[longest], -price, longest);
        }
        std::ranges::sort(found);
        std::vector<Index> order;
        for (const auto& border : found) order.push_back(std::get<2>(border));
        return order;
    }

    /// Joins two islands at this half-edge of the first one, unless they overlap.
    void join(Index crease)
    {
        const Index a = island_of(crease), b = island_of(twin(crease));
        const double longest = std::max({longest_, extent(islands_[a]), extent(islands_[b])});
        // The second island moves to the first one. Edges that then lie in one place are joined.
        std::vector<Index> joined;
        std::vector<Complex> before;
        for (const Index f : islands_[b])
            for (Index t = 3 * f; t < 3 * f + 3; ++t) {
                before.push_back(charts_.at[t]);
                const Index h = twin(t);
                if (h != no_twin && charts_.net.twin[h] == no_twin && chart_[face_of(h)] >= 0 && island_of(h) == a)
                    joined.push_back(h);
            }
        const PlaneMotion motion = motion_over(joined, crease);
        std::erase_if(joined, [&](Index h) { return !meets(h, motion); });
        for (const Index h : joined) charts_.net.join(h, twin(h));
        for (const Index f : islands_[b])
            for (Index c = 3 * f; c < 3 * f + 3; ++c) charts_.at[c] = motion(charts_.at[c]);
        std::vector<Index> faces = islands_[a];
        faces.insert(faces.end(), islands_[b].begin(), islands_[b].end());
        std::ranges::sort(faces);
        // Undo it if the joined island is too long, or overlaps itself.
        std::optional<FlatPart> part;
        if (!(extent(faces) > longest)) part = part_of(faces);
        if (!part) {
            auto at = before.begin();
            for (const Index f : islands_[b])
                for (Index c = 3 * f; c < 3 * f + 3; ++c) charts_.at[c] = *at++;
            for (const Index h : joined) charts_.net.cut(h);
            return;
        }
        parts_[a] = std::move(*part);
        islands_[a] = std::move(faces);
        islands_[b].clear();
        std::ranges::replace(island_, b, a);
    }

    const double longest_;  // extent of an island
};

/// The parts that are packed in the end.
const std::vector<FlatPart>& packed_parts_of(const UnfoldedParts& found)
{
    return are_worth_their_number(found.roomier, found.parts) ? found.roomier : found.parts;
}

/// A mesh that leaves most of the square empty, such as the cross of a cube, gets shorter islands if they are much
/// larger there, or about as large as more islands. @param unfold does it with other options
template <class Unfold>
std::optional<UnfoldedParts> larger_when_packed(const CutSurface& surface, UnfoldOptions options, const Unfold& unfold)
{
    std::optional<UnfoldedParts> whole = unfold(options);
    const double area = surface.areas.sum();
    if (!whole || !options.roomy || !whole->rest.empty() || area < whole_mesh) return whole;
    const double uncut = quickly_packed_scale(whole->parts);
    if (area * uncut * uncut >= tuning::packed_badly) return whole;
    options.compact = true;
    std::optional<UnfoldedParts> apart = unfold(options);
    if (!apart) return whole;
    const std::vector<FlatPart>&own = packed_parts_of(*whole), &other = packed_parts_of(*apart);
    const double larger = quickly_packed_scale(other) / quickly_packed_scale(own);
    const bool is_as_large = larger > 1.0 - tuning::noticeable && other.size() < own.size();
    return larger > tuning::worth_apart || is_as_large ? apart : whole;
}

std::optional<UnfoldedParts> unfolded_once(const CutSurface& surface, ExecutionContext& context,
                                           const UnfoldOptions& options)
{
    FlatCharts charts = flat_charts(surface, most_tips, options.hard_angle);
    if (!charts.rest.empty() || charts.faces.size() > most_charts) return {};
    Unfolding unfolding(surface, std::move(charts), options);
    if (options.roomy) unfolding.cut_strips();
    unfolding.join_charts(options.cut_hard, context);
    return UnfoldedParts{unfolding.parts(), {}, {}, unfolding.cut_length(), unfolding.noise()};
}

std::optional<UnfoldedParts> hard_parts_once(const CutSurface& surface, ExecutionContext& context,
                                             const UnfoldOptions& options)
{
    const double area = surface.areas.sum();
    if (!options.cut_hard)
        if (UnfoldedParts rolled{rolled_grid(surface, options.hard_angle, longest_island(area, options))};
            !rolled.parts.empty())
            return rolled;
    Unfolding unfolding(surface, flat_charts(surface, cone_tips, options.hard_angle), options);
    const bool is_hard = unfolding.hard_area(tuning::small_area * area) >= least_hard * area;
    if (!is_hard && !unfolding.keep_plates()) return {};
    if (options.roomy && is_hard) unfolding.cut_strips();
    unfolding.join_charts(options.cut_hard, context);
    if (is_hard) unfolding.attach_rest(context);
    UnfoldedParts found{unfolding.parts(), {}, unfolding.rest(), unfolding.cut_length(), unfolding.noise()};
    if (options.roomy && !options.cut_hard) found.roomier = unfolding.roomier(found.parts, context);
    return found;
}

}  // namespace

std::optional<UnfoldedParts> unfolded(const CutSurface& surface, ExecutionContext& context,
                                      const UnfoldOptions& options)
{
    return larger_when_packed(surface, options,
                              [&](const UnfoldOptions& own) { return unfolded_once(surface, context, own); });
}

std::optional<UnfoldedParts> hard_parts(const CutSurface& surface, ExecutionContext& context,
                                        const UnfoldOptions& options)
{
    return larger_when_packed(surface, options,
                              [&](const UnfoldOptions& own) { return hard_parts_once(surface, context, own); });
}

}  // namespace koebe
