#include "proxies/carried_net.h"

#include "core/connectivity.h"
#include "darts/tension.h"
#include "mesh/nearest_first.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <unordered_map>
#include <utility>

namespace koebe {
namespace {

constexpr double far_off = 4.0;       // price of an edge as far from a coarse edge as that is long, beside its length
constexpr int most_orders = 6;        // of chains, until all have paths that are no darts
constexpr std::size_t near_fork = 6;  // edges of a path on to which another one may turn

class PathFinder {
public:
    PathFinder(const Proxy& proxy, const CoarseNet& net)
        : fine_(proxy.fine.whole), coarse_(proxy.surface), vertex_(proxy.coarse.vertex)
    {
        mesh_ = seamed(fine_.vertices, fine_.surface, fine_.polygon, fine_.shown);
        taken_ = boundary_mask(fine_.surface);
        on_path_.assign(taken_.size(), 0);
        loop_of_.assign(taken_.size(), -1);
        for (std::size_t k = 0; k < fine_.surface.loops.size(); ++k)
            for (const Index v : fine_.surface.loops[k]) loop_of_[v] = static_cast<int>(k);
        firm_ = taken_;
        open_edges_.assign(vertex_.size(), 0);
        for (Index h = 0; h < static_cast<Index>(net.open.size()); ++h) {
            if (!net.open[h]) continue;
            taken_[fine_origin(h)] = taken_[fine_target(h)] = 1;  // paths go through no vertex of another chain
            ++open_edges_[origin(coarse_.triangles, h)];
        }
        for (std::size_t v = 0; v < open_edges_.size(); ++v)
            if (open_edges_[v] > 0 && open_edges_[v] != 2) firm_[vertex_[v]] = 1;
        const auto may_cut = [&](Index h) { return mesh_.twin[h] != no_twin && !mesh_.whole[h]; };
        begin_.assign(taken_.size() + 1, 0);
        for (Index h = 0; h < mesh_.halfedge_count(); ++h)
            if (may_cut(h)) ++begin_[origin(fine_.surface.triangles, h) + 1];
        for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
        leaving_.resize(begin_.back());
        std::vector<std::size_t> next(begin_.begin(), std::prev(begin_.end()));
        for (Index h = 0; h < mesh_.halfedge_count(); ++h)
            if (may_cut(h)) leaving_[next[origin(fine_.surface.triangles, h)]++] = h;
    }

    std::optional<CarriedPath> carried(const Path& chain)
    {
        // A dart may be left out. Other chains get a path that leaves some of their vertices out, or ends on the path
        // beside it, at its last vertex or its first one.
        std::optional<Path> path;
        for (int way = 0; !path && way < (is_dart(chain) ? 1 : 4); ++way) {
            if (way < 2) path = path_along(chain, way == 1);
            if (way == 2) path = path_onto_neighbour(chain);
            if (way == 3) path = path_onto_neighbour(reversed(chain, coarse_));
            if (way == 3 && path) path = reversed(*path, fine_.surface);
        }
        if (!path) return {};
        for (const Index h : *path)
            for (const Index v : {origin(fine_.surface.triangles, h), target(fine_.surface.triangles, h)})
                taken_[v] = firm_[v] = on_path_[v] = 1;
        note(chain.front(), *path);
        note(coarse_.twin[chain.back()], reversed(*path, fine_.surface));
        return CarriedPath{chain, std::move(*path)};
    }

    /// Whether a chain ends inside: without it the part has the same loops. Others divide parts, or join loops.
    bool is_dart(const Path& chain) const
    {
        const auto is_tip = [&](Index v) { return open_edges_[v] == 1; };
        return is_tip(origin(coarse_.triangles, chain.front())) || is_tip(target(coarse_.triangles, chain.back()));
    }

private:
    using Joins = std::function<bool(Index)>;

    static Path reversed(const Path& path, const Surface& surface)
    {
        Path back;
        for (auto h = path.rbegin(); h != path.rend(); ++h) back.push_back(surface.twin[*h]);
        return back;
    }

    /// Notes that a path leaves the end of a chain, if it is there.
    void note(Index coarse, const Path& path)
    {
        const Index v = origin(fine_.surface.triangles, path.front());
        if (v != fine_origin(coarse)) return;
        placed_[v].emplace_back(coarse, path.front());
        path_from_[path.front()] = path;
    }

    /// A path to the last vertex of a chain, or on to one of the two paths between which it would arrive there, from
    /// the side between them: a fine vertex may have fewer edges than chains meet there.
    std::optional<Path> path_onto_neighbour(const Path& chain) const
    {
        const Index arriving = coarse_.twin[chain.back()];
        const auto found = placed_.find(fine_target(chain.back()));
        if (found == placed_.end() || found->second.size() < 2) return {};
        const std::vector<Index> ring = leaving_of(coarse_, arriving);
        const auto turn = [&](Index h) {  // from the chain to another one, counter-clockwise
            const auto place = std::ranges::find(ring, h) - std::ranges::find(ring, arriving);
            return (place + static_cast<std::ptrdiff_t>(ring.size())) % static_cast<std::ptrdiff_t>(ring.size());
        };
        const auto& [left, right] =
            std::ranges::minmax(found->second, {}, [&](const auto& own) { return turn(own.first); });
        const Path &after = path_from_.at(left.second), &before = path_from_.at(right.second);
        return path_along(chain, true, [&](Index h) { return joins(h, after, false) || joins(h, before, true); });
    }

    /// Whether a half-edge arrives at one of the first vertices of a path, on its left or right side.
    bool joins(Index h, const Path& path, bool from_left) const
    {
        const Triangles& triangles = fine_.surface.triangles;
        for (std::size_t i = 0; i + 1 < std::min(path.size(), near_fork); ++i) {
            if (target(triangles, path[i]) != target(triangles, h)) continue;
            if (loop_of_[target(triangles, h)] >= 0) return false;
            const std::vector<Index> ring = leaving_of(fine_.surface, path[i + 1]);
            const auto place = [&](Index own) { return std::ranges::find(ring, own) - ring.begin(); };
            const auto own = place(fine_.surface.twin[h]), back = place(fine_.surface.twin[path[i]]);
            return own != 0 && own != back && (own < back) == from_left;
        }
        return false;
    }

    /// Half-edges that leave a vertex, counter-clockwise; from the boundary on, if the vertex is there.
    static std::vector<Index> leaving_of(const Surface& surface, Index h)
    {
        const Index start = h;
        for (Index t = surface.twin[h]; t != no_twin && next_halfedge(t) != start; t = surface.twin[h])
            h = next_halfedge(t);
        std::vector<Index> ring{h};
        for (Index t = surface.twin[previous_halfedge(h)]; t != no_twin && t != ring.front();
             t = surface.twin[previous_halfedge(t)])
            ring.push_back(t);
        return ring;
    }

    /// Whether chains leave their common end in the same order as their paths, with one more path.
    bool keeps_order(Index coarse, Index fine) const
    {
        const auto found = placed_.find(origin(fine_.surface.triangles, fine));
        if (found == placed_.end()) return true;
        std::vector<std::pair<Index, Index>> all = found->second;
        all.emplace_back(coarse, fine);
        const std::vector<Index> here = leaving_of(coarse_, coarse), there = leaving_of(fine_.surface, fine);
        const auto place = [](const std::vector<Index>& ring, Index h) {
            return std::ranges::find(ring, h) - ring.begin();
        };
        std::ranges::sort(all, {}, [&](const auto& own) { return place(here, own.first); });
        int descents = 0;
        for (std::size_t i = 0; i < all.size(); ++i)
            descents += place(there, all[(i + 1) % all.size()].second) <= place(there, all[i].second);
        const bool is_open = loop_of_[found->first] >= 0;  // then the order has a beginning
        return descents <= 1 && (!is_open || place(there, all.back().second) >= place(there, all.front().second));
    }

    Index fine_origin(Index coarse) const { return vertex_[origin(coarse_.triangles, coarse)]; }
    Index fine_target(Index coarse) const { return vertex_[target(coarse_.triangles, coarse)]; }

    /// A short path near a chain, through its vertices. @param loose it may leave some of them out, and go through
    /// vertices of other chains @param joins whether it may end with a half-edge; empty: only at the chain's end
    std::optional<Path> path_along(const Path& chain, bool loose, const Joins& joins = {}) const
    {
        std::vector<char> taken = loose ? firm_ : taken_;
        Path path;
        Index from = fine_origin(chain.front());
        for (std::size_t i = 0; i < chain.size(); ++i) {
            const bool is_first = path.empty(), is_last = i + 1 == chain.size();
            const Index to = fine_target(chain[i]);
            const ChainEnds ends{is_first ? chain.front() : no_twin, is_last ? coarse_.twin[chain[i]] : no_twin};
            std::optional<Path> step;
            if (is_last || !on_path_[to]) {
                step = path_between(from, to, ends, taken, false, is_last ? joins : Joins{});
                if (!step && (is_first || is_last)) step = path_between(from, to, ends, taken, true);
            }
            if (!step && loose && !is_last) continue;
            if (!step) return {};
            for (const Index h : *step) taken[target(fine_.surface.triangles, h)] = 1;
            path.insert(path.end(), step->begin(), step->end());
            from = to;
        }
        return path.empty() ? std::nullopt : std::optional(std::move(path));
    }

    /// Half-edges that leave the ends of a chain, no_twin for none.
    struct ChainEnds {
        Index first, last;
    };

    /// The shortest path near a straight line. @param ends if the path is the first or last one of a chain @param
    /// taken (V) 1: the path may not touch it @param anywhere ends on the boundary may be elsewhere on the same loop
    std::optional<Path> path_between(Index from, Index to, const ChainEnds& ends, const std::vector<char>& taken,
                                     bool anywhere, const Joins& joins = {}) const
    {
        const Triangles& triangles = fine_.surface.triangles;
        const Eigen::RowVector3d start = fine_.vertices.row(from), along = fine_.vertices.row(to) - start;
        // From the first vertex, or anywhere on its loop.
        NearestFirst nearest(fine_.surface.vertex_count);
        std::unordered_map<Index, Index> last;
        nearest.reach(from, 0.0);
        if (anywhere && loop_of_[from] >= 0 && loop_of_[from] != loop_of_[to])
            for (const Index v : fine_.surface.loops[loop_of_[from]])
                if (!on_path_[v]) nearest.reach(v, 0.0);
        const auto is_end = [&](Index v) {
            return v == to || (joins && v != from && on_path_[v]) ||
                   (anywhere && loop_of_[to] >= 0 && loop_of_[v] == loop_of_[to] && loop_of_[to] != loop_of_[from] &&
                    !on_path_[v]);
        };
        // To the first end. An edge counts as longer by the square of its distance from the line.
        Index end = nearest.take();
        for (Index v = end; v >= 0 && !is_end(v); v = end = nearest.take())
            for (std::size_t i = begin_[v]; i < begin_[v + 1]; ++i) {
                const Index h = leaving_[i], w = target(triangles, h);
                if (taken[w] && (joins && w != to ? !joins(h) : !is_end(w))) continue;
                if (v == from && ends.first != no_twin && !keeps_order(ends.first, h)) continue;
                if (w == to && ends.last != no_twin && !keeps_order(ends.last, fine_.surface.twin[h])) continue;
                const Eigen::RowVector3d off = 0.5 * (fine_.vertices.row(v) + fine_.vertices.row(w)) - start;
                const double share = std::clamp(off.dot(along) / along.squaredNorm(), 0.0, 1.0);
                const double price = 1.0 + far_off * (off - share * along).squaredNorm() / along.squaredNorm();
                if (nearest.reach(w, nearest.distance()[v] + mesh_.length[h] * price)) last[w] = h;
            }
        if (end < 0) return {};
        Path path;
        for (Index v = end; last.contains(v); v = origin(triangles, last[v])) path.push_back(last[v]);
        std::ranges::reverse(path);
        return path;
    }

    const CutSurface& fine_;
    const Surface& coarse_;
    const std::vector<Index>& vertex_;  // (V) coarse: the fine vertex
    SeamedMesh mesh_;
    std::vector<char> taken_, firm_,
        on_path_;                  // (V) fine: on the boundary or a chain, the same but inside chains, on a path
    std::vector<int> loop_of_;     // (V) fine; -1 inside
    std::vector<int> open_edges_;  // (V) coarse: how many half-edges on boundaries leave it
    std::vector<std::size_t> begin_;
    std::unordered_map<Index, std::vector<std::pair<Index, Index>>> placed_;  // by the fine vertex: as they leave it
    std::unordered_map<Index, Path> path_from_;                               // by its first half-edge
    std::vector<Index> leaving_;  // half-edges that may be cut, by the vertex that they leave
};

}  // namespace

bool CoarseNet::parts_differ(const Surface& surface, Index halfedge) const
{
    return place[face_of(halfedge)].part != place[face_of(surface.twin[halfedge])].part;
}

std::optional<CoarseNet> coarse_net(const Proxy& proxy, const std::vector<FlatPart>& parts)
{
    const Triangles& triangles = proxy.surface.triangles;
    CoarseNet net{std::vector<CoarseNet::Place>(static_cast<std::size_t>(triangles.rows())),
                  std::vector<char>(proxy.surface.twin.size(), 0)};
    for (std::size_t k = 0; k < parts.size(); ++k)
        for (std::size_t i = 0; i < parts[k].faces.size(); ++i) {
            const Index face = parts[k].faces[i];
            if (net.place[face].part >= 0) return {};
            net.place[face] = {static_cast<int>(k), static_cast<Index>(i)};
            for (int c = 0; c < 3; ++c) {
                const Index corner = parts[k].surface.triangles(static_cast<Eigen::Index>(i), c);
                if (parts[k].original[corner] != triangles(face, c)) return {};
                if (parts[k].surface.twin[3 * i + static_cast<std::size_t>(c)] == no_twin) net.open[3 * face + c] = 1;
            }
        }
    if (std::ranges::any_of(net.place, [](const auto& own) { return own.part < 0; })) return {};
    return net;
}

std::vector<CarriedPath> carried_paths(const Proxy& proxy, const CoarseNet& net, const ExecutionContext& context)
{
    const PathFinder first(proxy, net);
    const auto is_needed = [&](const Path& chain) { return !first.is_dart(chain); };
    std::vector<Path> chains = chains_of(proxy.surface, net.open);
    // Chains that a part needs come before darts, which may stay out.
    std::stable_partition(chains.begin(), chains.end(), is_needed);
    std::vector<CarriedPath> best;
    std::size_t fewest = chains.size() + 1;
    // A path can block a later one: so blocked chains go first in the next round.
    for (int order = 0; order < most_orders && fewest > 0; ++order) {
        PathFinder finder(proxy, net);
        std::vector<CarriedPath> all;
        std::vector<Path> blocked, others;
        for (const Path& chain : chains) {
            context.checkpoint();
            auto path = finder.carried(chain);
            (path || !is_needed(chain) ? others : blocked).push_back(chain);
            if (path) all.push_back(std::move(*path));
        }
        if (blocked.size() < fewest) {
            fewest = blocked.size();
            best = std::move(all);
        }
        chains = std::move(blocked);
        std::ranges::move(others, std::back_inserter(chains));
    }
    return best;
}

std::vector<CarriedPath> straightened(const Proxy& proxy, std::vector<CarriedPath> paths,
                                      const ExecutionContext& context)
{
    std::vector<Path> straight;
    for (CarriedPath& own : paths) straight.push_back(std::move(own.path));
    straighten(proxy.fine.whole, straight, context);
    for (std::size_t i = 0; i < paths.size(); ++i) paths[i].path = std::move(straight[i]);
    return paths;
}

}  // namespace koebe
