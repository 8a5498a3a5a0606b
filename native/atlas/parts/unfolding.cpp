#include "parts/unfolding.h"

#include "core/errors.h"
#include "parts/dart_rounds.h"
#include "parts/flat_charts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace koebe {
namespace {

constexpr double least_border = 0.12;  // of a chart's boundary: a shorter common border is not worth joining
constexpr std::size_t most_tips = 64;    // of one chart,
constexpr std::size_t most_charts = 300; // of a surface: else it is smooth, or rough
constexpr std::size_t cone_tips = 2;     // of a chart of a hard surface
constexpr double large_chart = 0.01;     // of the area: charts from there on
constexpr double least_hard = 0.5;       // of the area: hold so much of a hard surface

/// A plane motion that keeps orientation.
struct Motion {
    Complex turn, shift;
    Complex operator()(Complex z) const { return turn * z + shift; }
};

class Unfolding {
public:
    explicit Unfolding(const CutSurface& surface, FlatCharts charts)
        : surface_(surface), charts_(std::move(charts)), islands_(charts_.faces), island_(islands_.size())
    {
        std::iota(island_.begin(), island_.end(), 0);
        chart_.assign(static_cast<std::size_t>(surface.areas.size()), -1);
        for (std::size_t k = 0; k < islands_.size(); ++k)
            for (const Index f : islands_[k]) chart_[f] = static_cast<Index>(k);
    }

    /// Charts that overlap themselves go to the rest, and single small faces.
    void take_charts(ExecutionContext& context)
    {
        parts_.resize(islands_.size());
        for (std::size_t k = 0; k < islands_.size(); ++k) {
            context.checkpoint();
            if (auto part = part_of(islands_[k])) {
                parts_[k] = std::move(*part);
                continue;
            }
            for (const Index f : islands_[k]) chart_[f] = -1;
            charts_.rest.insert(charts_.rest.end(), islands_[k].begin(), islands_[k].end());
            islands_[k].clear();
        }
    }

    /// The area of flat and rolled charts that are not small.
    double large_area(double least) const
    {
        double sum = 0.0;
        for (const std::vector<Index>& faces : islands_)
            if (const double area = surface_.areas(faces).sum(); area >= least) sum += area;
        return sum;
    }

    void join_charts(ExecutionContext& context)
    {
        for (const Index h : borders()) {
            context.checkpoint();
            const Index a = island_of(h), b = island_of(twin(h));
            if (a == b) continue;
            islands_[a].size() < islands_[b].size() ? join(twin(h)) : join(h);
        }
    }

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

private:
    Index halfedges() const { return charts_.net.halfedge_count(); }
    Index twin(Index h) const { return surface_.surface.twin[h]; }
    Index island_of(Index h) const { return island_[chart_[face_of(h)]]; }

    bool same(Complex a, Complex b) const { return std::abs(a - b) < charts_.near; }

    /// The motion that brings the face across a crease to the crease's place.
    Motion motion_to(Index h) const
    {
        const Index t = twin(h);
        const Complex from = charts_.at[next_halfedge(t)] - charts_.at[t],
                      to = charts_.at[h] - charts_.at[next_halfedge(h)];
        const Complex turn = to / from / std::abs(to / from);
        return {turn, charts_.at[next_halfedge(h)] - turn * charts_.at[t]};
    }

    bool meets(Index h, const Motion& motion) const
    {
        const Index t = twin(h);
        return same(motion(charts_.at[t]), charts_.at[next_halfedge(h)]) &&
               same(motion(charts_.at[next_halfedge(t)]), charts_.at[h]);
    }

    /// For each pair of charts the crease at which they are best joined, if their straight common border is long
    /// enough. The longest border first.
    std::vector<Index> borders() const
    {
        std::map<std::pair<Index, Index>, std::vector<Index>> common;
        std::vector<double> boundary(islands_.size(), 0.0);
        for (Index h = 0; h < halfedges(); ++h) {
            if (charts_.net.twin[h] != no_twin) continue;
            const Index a = chart_[face_of(h)];
            if (a < 0) continue;
            boundary[a] += surface_.lengths[h];
            if (twin(h) == no_twin) continue;
            if (const Index b = chart_[face_of(twin(h))]; a < b) common[{a, b}].push_back(h);
        }
        std::vector<std::pair<double, Index>> found;
        for (const auto& [charts, halfedges] : common) {
            const Index longest =
                *std::ranges::max_element(halfedges, {}, [&](Index h) { return surface_.lengths[h]; });
            const Motion motion = motion_to(longest);
            double length = 0.0, price = 0.0;
            for (const Index h : halfedges)
                if (meets(h, motion)) {
                    length += surface_.lengths[h];
                    price += charts_.net.length[h];
                }
            if (length >= least_border * std::min(boundary[charts.first], boundary[charts.second]))
                found.emplace_back(-price, longest);
        }
        std::ranges::sort(found);
        std::vector<Index> order;
        for (const auto& border : found) order.push_back(border.second);
        return order;
    }

    /// Joins two islands at this half-edge of the first one, unless they overlap.
    void join(Index crease)
    {
        const Index a = island_of(crease), b = island_of(twin(crease));
        const Motion motion = motion_to(crease);
        std::vector<Index> joined;
        std::vector<Complex> before;
        for (const Index f : islands_[b])
            for (Index t = 3 * f; t < 3 * f + 3; ++t) {
                before.push_back(charts_.at[t]);
                const Index h = twin(t);
                if (h == no_twin || charts_.net.twin[h] != no_twin || chart_[face_of(h)] < 0 || island_of(h) != a ||
                    !meets(h, motion))
                    continue;
                joined.push_back(h);
            }
        for (const Index h : joined) {
            charts_.net.twin[h] = twin(h);
            charts_.net.twin[twin(h)] = h;
        }
        for (const Index f : islands_[b])
            for (Index c = 3 * f; c < 3 * f + 3; ++c) charts_.at[c] = motion(charts_.at[c]);
        std::vector<Index> faces = islands_[a];
        faces.insert(faces.end(), islands_[b].begin(), islands_[b].end());
        std::ranges::sort(faces);
        auto part = part_of(faces);
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

    /// These faces as they lie. @return no value if they are no disk with holes, or overlap
    std::optional<FlatPart> part_of(const std::vector<Index>& faces) const
    {
        std::vector<Index> number(charts_.net.face.size(), -1);
        for (std::size_t i = 0; i < faces.size(); ++i) number[faces[i]] = static_cast<Index>(i);
        SeamedMesh mesh;
        mesh.corners = charts_.net.corners(faces, Eigen::all);
        for (const Index f : faces)
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                const Index t = charts_.net.twin[h];
                mesh.twin.push_back(t == no_twin ? no_twin : 3 * number[face_of(t)] + t % 3);
            }
        number_fans(mesh);
        FlatPart part;
        part.faces = faces;
        part.original.resize(mesh.fan_count);
        part.points.resize(mesh.fan_count, 2);
        // Up to tolerances corners of one vertex lie in one place. The largest plane stays exact.
        std::vector<double> plane(static_cast<std::size_t>(mesh.fan_count), -1.0);
        for (Index h = 0; h < mesh.halfedge_count(); ++h) {
            const Index v = origin(mesh.fans, h), f = faces[face_of(h)];
            if (!(charts_.plane[f] > plane[v])) continue;
            const Complex z = charts_.at[3 * f + h % 3];
            plane[v] = charts_.plane[f];
            part.original[v] = origin(mesh.corners, h);
            part.points.row(v) << z.real(), z.imag();
        }
        part.vertices = surface_.vertices(part.original, Eigen::all);
        try {
            part.surface = require_bordered_genus_zero(mesh.fans, mesh.fan_count);
        } catch (const TopologyError&) {  // two islands that close a ring meet in one vertex
            return {};
        }
        if (!lies_one_to_one(part, part.points) || !survives_storing(part)) return {};
        part.rims.assign(part.surface.loops.begin(), part.surface.loops.end());
        part.held.assign(mesh.fan_count, 0);
        for (const VertexLoop& loop : part.surface.loops) {
            part.loops.emplace_back();
            for (const Index v : loop) part.loops.back().push_back(part.original[v]);
        }
        for (Index v = 0; v < mesh.fan_count; ++v)
            if (charts_.tips.contains(part.original[v]) && std::ranges::count(part.original, part.original[v]) == 1)
                part.tips.push_back(v);
        if (!surface_.polygon.empty())
            for (const Index f : faces) part.polygon.push_back(surface_.polygon[f]);
        return part;
    }

    const CutSurface& surface_;
    FlatCharts charts_;                        // twins over creases where charts are joined
    std::vector<std::vector<Index>> islands_;  // faces of joined charts, ascending
    std::vector<Index> island_;                // (charts)
    std::vector<Index> chart_;                 // (F)
    std::vector<FlatPart> parts_;              // (islands)
};

}  // namespace

std::optional<UnfoldedParts> unfolded(const CutSurface& surface, ExecutionContext& context)
{
    FlatCharts charts = flat_charts(surface, most_tips);
    if (!charts.rest.empty() || charts.faces.size() > most_charts) return {};
    Unfolding unfolding(surface, std::move(charts));
    unfolding.take_charts(context);
    std::vector<Index> rest = unfolding.rest();
    if (!rest.empty()) return {};
    unfolding.join_charts(context);
    return UnfoldedParts{unfolding.parts(), std::move(rest), unfolding.cut_length()};
}

std::optional<UnfoldedParts> hard_parts(const CutSurface& surface, ExecutionContext& context)
{
    const double area = surface.areas.sum();
    Unfolding unfolding(surface, flat_charts(surface, cone_tips));
    if (!(unfolding.large_area(large_chart * area) >= least_hard * area)) return {};
    unfolding.take_charts(context);
    if (!(unfolding.large_area(large_chart * area) >= least_hard * area)) return {};
    unfolding.join_charts(context);
    return UnfoldedParts{unfolding.parts(), unfolding.rest(), unfolding.cut_length()};
}

}  // namespace koebe
