#include "splitting/straight_paths.h"

#include "core/connectivity.h"
#include "cost/costs.h"
#include "mesh/nearest_first.h"
#include "mesh/topology.h"
#include "splitting/coarse_surface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

namespace koebe {
namespace {

constexpr double band_edges = 1.5;       // the width of the band at least, in mean edges of the path
constexpr double band_share = 0.1;       // of the path's length: the width at most, if that is more
constexpr std::size_t least_closed = 8;  // edges of a closed path that is straightened
constexpr double worth_moving = 0.99;    // of a path's cost: a better one costs less

}  // namespace

class PathStraightener::Search {
public:
    explicit Search(const CutSurface& whole)
        : whole_(whole),
          triangles_(whole.surface.triangles),
          twin_(whole.surface.twin),
          from_path_(whole.surface.vertex_count),
          from_start_(static_cast<Index>(twin_.size())),
          last_(twin_.size(), no_twin),
          is_cut_(twin_.size(), 0),
          passes_(fixed_places(whole.surface))
    {
        for (Index h = 0; h < static_cast<Index>(twin_.size()); ++h) price_.push_back(length_as_cut(whole, h));
        note_directions();
    }

    /// A path stays where others end on it. One that closes is straightened half by half.
    double straighten(Path& path)
    {
        const double before = length_of(path);
        const Path old = path;
        note(path, -1);
        const bool closes = origin(triangles_, path.front()) == target(triangles_, path.back());
        const auto is_free = [&](Index h) { return passes_[origin(triangles_, h)] == 0; };
        if (closes && std::ranges::all_of(path, is_free)) {
            for (const double from : {0.0, 0.5, 0.25})
                if (path.size() >= least_closed) {
                    const auto first = static_cast<std::size_t>(from * static_cast<double>(path.size()));
                    straighten_range(path, first, first + path.size() / 2, true);
                }
        } else {
            for (std::size_t first = 0; first < path.size();) {
                std::size_t end = first + 1;
                const std::size_t most = closes ? (path.size() + 1) / 2 : path.size();
                while (end < path.size() && end - first < most && is_free(path[end])) ++end;
                first += straighten_range(path, first, end, false);
            }
        }
        note(path, 1);
        return path == old ? 0.0 : std::max(before - length_of(path), 0.0);
    }

    void note(const Path& path, int sign)
    {
        for (const Index h : path) {
            is_cut_[h] = is_cut_[twin_[h]] = sign > 0;
            passes_[origin(triangles_, h)] += sign;
            passes_[target(triangles_, h)] += sign;
        }
    }

private:
    /// Paths end on the boundary and go through hubs, but none is moved there.
    static std::vector<int> fixed_places(const Surface& surface)
    {
        std::vector<int> faces(static_cast<std::size_t>(surface.vertex_count), 0);
        for (const Index v : surface.triangles.reshaped<Eigen::RowMajor>()) ++faces[v];
        std::vector<int> fixed;
        for (const int count : faces) fixed.push_back(count > hub_faces);
        for (const VertexLoop& loop : surface.loops)
            for (const Index v : loop) fixed[v] = 1;
        return fixed;
    }

    /// The direction of each half-edge at its origin: the angle from the first one, counter-clockwise, so that all
    /// angles round the vertex are 2 pi.
    void note_directions()
    {
        direction_.assign(twin_.size(), 0.0);
        std::vector<Index> leaving(static_cast<std::size_t>(whole_.surface.vertex_count), no_twin);
        for (Index h = 0; h < static_cast<Index>(twin_.size()); ++h) {
            Index& first = leaving[origin(triangles_, h)];
            if (first == no_twin || twin_[h] == no_twin) first = h;
        }
        leaving_ = std::move(leaving);
        for (const Index first : leaving_) {
            double sum = 0.0;
            for_ring(first, [&](Index h) {
                direction_[h] = sum;
                sum += angle_at_origin(h);
            });
            for_ring(first, [&](Index h) { direction_[h] *= 2.0 * std::numbers::pi / sum; });
        }
    }

    double angle_at_origin(Index h) const
    {
        const auto at = [&](Index v) { return whole_.vertices.row(v); };
        const Index v = origin(triangles_, h);
        const Eigen::RowVector3d a = at(target(triangles_, h)) - at(v),
                                 b = at(origin(triangles_, previous_halfedge(h))) - at(v);
        return std::max(std::atan2(a.cross(b).norm(), a.dot(b)), 1e-9);
    }

    /// Visits the half-edges that leave a vertex, counter-clockwise from one of them; on the boundary from the first
    /// one.
    template <class Visit>
    void for_ring(Index first, const Visit& visit) const
    {
        for (Index h = first; h != no_twin;) {
            visit(h);
            h = twin_[previous_halfedge(h)];
            if (h == first) return;
        }
    }

    /// Edges of the boundary, and edges inside polygons, belong to no path.
    bool may_cut(Index h) const
    {
        const Index t = twin_[h];
        return t != no_twin && (whole_.polygon.empty() || whole_.polygon[face_of(h)] != whole_.polygon[face_of(t)]);
    }

    /// turn_cost |angle - pi| / (pi / 2) times the mean price of both edges, with the angle from one to the other.
    double turn_cost(Index arriving, Index leaving) const
    {
        const double full = 2.0 * std::numbers::pi;
        double angle = direction_[leaving] - direction_[twin_[arriving]];
        angle -= full * std::floor(angle / full);
        return tuning::turn_cost * std::abs(angle - std::numbers::pi) / (0.5 * std::numbers::pi) * 0.5 *
               (price_[arriving] + price_[leaving]);
    }

    /// price (1 + (distance / width)^2), with the distance of the edge's middle from the path.
    double edge_cost(Index h, double width) const
    {
        const double off =
            0.5 * (from_path_.distance()[origin(triangles_, h)] + from_path_.distance()[target(triangles_, h)]) / width;
        return price_[h] * (1.0 + off * off);
    }

    /// Its length with factors and turns; near another path, the sum that `improved` makes least.
    double length_of(const Path& path) const
    {
        return sum_of(path, [&](Index h) { return price_[h]; });
    }
    double cost_of(const Path& path, Index before, Index after, double width) const
    {
        double sum = sum_of(path, [&](Index h) { return edge_cost(h, width); });
        if (before != no_twin) sum += turn_cost(before, path.front());
        if (after != no_twin) sum += turn_cost(path.back(), after);
        return sum;
    }

    template <typename CostOfEdge>
    double sum_of(const Path& path, const CostOfEdge& cost_of_edge) const
    {
        double sum = 0.0;
        for (std::size_t i = 0; i < path.size(); ++i) {
            sum += cost_of_edge(path[i]);
            if (i > 0) sum += turn_cost(path[i - 1], path[i]);
        }
        return sum;
    }

    /// Half-edges that leave a vertex between the two cuts beside one of them.
    std::vector<Index> sector(Index h) const
    {
        std::vector<Index> own{h};
        for (Index k = twin_[previous_halfedge(h)]; k != no_twin && k != h && !is_cut_[k];
             k = twin_[previous_halfedge(k)])
            own.push_back(k);
        for (Index t = twin_[h]; t != no_twin;) {
            const Index k = next_halfedge(t);
            if (k == h || is_cut_[k]) break;
            own.push_back(k);
            t = twin_[k];
        }
        return own;
    }

    /// Measures how far vertices lie from a path, up to the width of its band. @return that width
    double measure_band(const Path& path)
    {
        const Index start = origin(triangles_, path.front()), end = target(triangles_, path.back());
        double length = 0.0;
        for (const Index h : path) length += whole_.lengths[h];
        const double width = std::max(std::min(tuning::straight_band, band_share * length),
                                      band_edges * length / static_cast<double>(path.size()));
        from_path_.reset();
        from_path_.reach(start, 0.0);
        for (const Index h : path) from_path_.reach(target(triangles_, h), 0.0);
        for (Index v = from_path_.take(); v >= 0; v = from_path_.take()) {
            if (v != start && v != end && passes_[v] > 0) continue;
            for_ring(leaving_[v], [&](Index h) {
                const Index w = target(triangles_, h);
                const double distance = from_path_.distance()[v] + whole_.lengths[h];
                if (distance <= width && passes_[w] == 0) from_path_.reach(w, distance);
            });
        }
        return width;
    }

    /// A better path with the same ends, by the costs of half-edges one after the other; empty: there is none.
    /// @param before, after half-edges with which it is continued; no_twin: it is not
    Path improved(const Path& path, Index before, Index after)
    {
        const Index start = origin(triangles_, path.front()), end = target(triangles_, path.back());
        const double width = measure_band(path);
        from_start_.reset();
        // The nodes of the search are half-edges, not vertices: so a turn has a cost.
        const auto step = [&](Index from, Index h, double cost) {  // from_start_ reaches h
            const Index v = target(triangles_, h);
            if (v == start || is_cut_[h] || !may_cut(h) || (v != end && !is_inside(v))) return;
            if (from_start_.reach(h, cost + edge_cost(h, width))) last_[h] = from;
        };
        for (const Index h : sector(path.front())) step(no_twin, h, before == no_twin ? 0.0 : turn_cost(before, h));
        // It arrives from the same side of the other cuts, and ends once none can be cheaper.
        const std::vector<Index> ends = sector(twin_[path.back()]);
        double best = worth_moving * cost_of(path, before, after, width);
        Index found = no_twin;
        for (Index h = from_start_.take(); h >= 0 && from_start_.distance()[h] < best; h = from_start_.take()) {
            const double cost = from_start_.distance()[h];
            if (target(triangles_, h) != end) {
                for_ring(leaving_[target(triangles_, h)], [&](Index k) {
                    if (k != twin_[h]) step(h, k, cost + turn_cost(h, k));
                });
                continue;
            }
            const double turned = cost + (after == no_twin ? 0.0 : turn_cost(h, after));
            if (turned >= best || std::ranges::find(ends, twin_[h]) == ends.end()) continue;
            best = turned;
            found = h;
        }
        Path better;
        for (Index h = found; h != no_twin; h = last_[h]) better.push_back(h);
        std::ranges::reverse(better);
        return meets_itself(better) ? Path{} : better;
    }

    bool is_inside(Index v) const { return std::isfinite(from_path_.distance()[v]); }

    bool meets_itself(const Path& path) const
    {
        std::vector<Index> ends;
        for (const Index h : path) ends.push_back(target(triangles_, h));
        std::ranges::sort(ends);
        return std::ranges::adjacent_find(ends) != ends.end();
    }

    /// Straightens the edges of a path from `first` to before `end`. @param is_round whether the path goes on from its
    /// end to its beginning @return how many edges they are now
    std::size_t straighten_range(Path& path, std::size_t first, std::size_t end, bool is_round)
    {
        const auto from = path.begin() + static_cast<std::ptrdiff_t>(first);
        const auto to = path.begin() + static_cast<std::ptrdiff_t>(end);
        const Path part(from, to), head(path.begin(), from), tail(to, path.end());
        const Index last = is_round ? path.back() : no_twin, next = is_round ? path.front() : no_twin;
        note(head, 1);
        note(tail, 1);
        const Path better = improved(part, head.empty() ? last : head.back(), tail.empty() ? next : tail.front());
        note(head, -1);
        note(tail, -1);
        if (better.empty()) return part.size();
        path = head;
        path.insert(path.end(), better.begin(), better.end());
        path.insert(path.end(), tail.begin(), tail.end());
        return better.size();
    }

    const CutSurface& whole_;
    const Triangles& triangles_;
    const std::vector<Index>& twin_;
    std::vector<double> price_;      // (3F) lengths with factors
    std::vector<double> direction_;  // (3F)
    std::vector<Index> leaving_;     // (V) a half-edge; the first one counter-clockwise on the boundary
    NearestFirst from_path_;         // (V)
    NearestFirst from_start_;        // (3F) costs
    std::vector<Index> last_;        // (3F) the half-edge before
    std::vector<char> is_cut_;       // (3F)
    std::vector<int> passes_;        // (V) how many edges of paths end there; one more where paths are not moved
};

std::vector<Path> chains_of(const Surface& surface, const std::vector<char>& is_cut)
{
    const Triangles& triangles = surface.triangles;
    // Cut edges that leave each vertex.
    std::vector<std::vector<Index>> leaving(static_cast<std::size_t>(surface.vertex_count));
    for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h)
        if (surface.twin[h] != no_twin && (is_cut[h] || is_cut[surface.twin[h]]))
            leaving[origin(triangles, h)].push_back(h);
    const std::vector<char> outside = boundary_mask(surface);
    std::vector<char> seen(surface.twin.size(), 0);
    std::vector<Path> all;
    // Chains end at the border, and where not two edges meet.
    const auto is_node = [&](Index v) { return outside[v] != 0 || leaving[v].size() != 2; };
    const auto walk = [&](Index h, Index start) {
        Path chain{h};
        for (Index end = target(triangles, h); !is_node(end) && end != start; end = target(triangles, h)) {
            h = leaving[end][leaving[end][0] == surface.twin[h] ? 1 : 0];
            chain.push_back(h);
        }
        for (const Index own : chain) seen[own] = seen[surface.twin[own]] = 1;
        all.push_back(std::move(chain));
    };
    // Chains between nodes first; what is left is closed.
    for (const bool closed : {false, true})
        for (Index v = 0; v < surface.vertex_count; ++v)
            if (is_node(v) != closed)
                for (const Index h : leaving[v])
                    if (!seen[h]) walk(h, v);
    return all;
}

PathStraightener::PathStraightener(const CutSurface& whole) : search_(std::make_unique<Search>(whole)) {}

PathStraightener::~PathStraightener() = default;

void PathStraightener::add(const Path& path) { search_->note(path, 1); }

double PathStraightener::straighten(Path& path) { return search_->straighten(path); }

void PathStraightener::replace(Path& path, Path by)
{
    search_->note(path, -1);
    path = std::move(by);
    search_->note(path, 1);
}

void straighten(const CutSurface& whole, std::vector<Path>& paths, const ExecutionContext& context)
{
    PathStraightener straightener(whole);
    for (const Path& path : paths) straightener.add(path);
    for (Path& path : paths) {
        context.checkpoint();
        straightener.straighten(path);
    }
}

}  // namespace koebe
