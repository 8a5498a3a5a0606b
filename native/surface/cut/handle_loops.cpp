#include "cut/handle_loops.h"

#include "cut/disjoint_sets.h"
#include "cut/edge_graph.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace koebe {
namespace {

constexpr double boundary_price = 30.0;  // factor on the length of an edge at the boundary
constexpr double about_as_short = 2.0;   // loops up to so many times the shortest are cut together with it

struct Loop {
    std::vector<Index> halfedges;
    double length = 0.0;
};

class HandleFinder {
public:
    explicit HandleFinder(const SeamedMesh& mesh) : mesh_(mesh), graph_(mesh, boundary_price), hole_(mesh.twin.size())
    {
        const auto loops = boundary_halfedges(mesh);
        for (std::size_t k = 0; k < loops.size(); ++k)
            for (const Index h : loops[k]) hole_[h] = static_cast<Index>(k);
        dual_count_ = mesh.face.size() + loops.size();
    }

    /// The loops of a basis, shortest first, without the path from the base point to them.
    std::vector<Loop> basis(Index base)
    {
        tree_ = shortest_paths(graph_, {base});
        std::vector<Loop> loops;
        for (const Index h : left_over()) loops.push_back(loop_through(h));
        std::ranges::stable_sort(loops, {}, &Loop::length);
        return loops;
    }

    /// The vertex farthest from all base points so far.
    Index farthest()
    {
        nearest_.resize(tree_.distance.size(), std::numeric_limits<double>::max());
        for (std::size_t v = 0; v < nearest_.size(); ++v) nearest_[v] = std::min(nearest_[v], tree_.distance[v]);
        return static_cast<Index>(std::ranges::max_element(nearest_) - nearest_.begin());
    }

private:
    /// Edges in neither tree, each by its lower half-edge.
    std::vector<Index> left_over() const
    {
        std::vector<char> in_tree(mesh_.twin.size(), 0);
        for (const Index h : tree_.halfedge)
            if (h != no_twin) in_tree[h] = 1;
        std::vector<std::pair<double, Index>> candidates;
        for (Index h = 0; h < mesh_.halfedge_count(); ++h) {
            if (in_tree[h] || (mesh_.twin[h] != no_twin && mesh_.twin[h] < h)) continue;
            const double through =
                tree_.distance[origin(mesh_.fans, h)] + tree_.distance[target(mesh_.fans, h)] + graph_.length(h);
            candidates.emplace_back(mesh_.whole[h] ? -std::numeric_limits<double>::max() : -through, h);
        }
        std::ranges::sort(candidates);
        DisjointSets sets(dual_count_);
        std::vector<Index> left;
        for (const auto& [key, h] : candidates) {
            const Index twin = mesh_.twin[h];
            const Index across = twin != no_twin ? face_of(twin) : static_cast<Index>(mesh_.face.size()) + hole_[h];
            if (!sets.join(face_of(h), across)) left.push_back(h);
        }
        return left;
    }

    Loop loop_through(Index h) const
    {
        std::vector<Index> out = tree_.path(origin(mesh_.fans, h)), back = tree_.path(target(mesh_.fans, h));
        while (!out.empty() && !back.empty() && out.back() == back.back()) {
            out.pop_back();
            back.pop_back();
        }
        std::ranges::reverse(out);
        Loop loop{std::move(out)};
        loop.halfedges.push_back(h);
        loop.halfedges.insert(loop.halfedges.end(), back.begin(), back.end());
        for (const Index g : loop.halfedges) loop.length += graph_.length(g);
        return loop;
    }

    const SeamedMesh& mesh_;
    EdgeGraph graph_;
    std::vector<Index> hole_;  // of each boundary half-edge
    std::size_t dual_count_ = 0;
    PathTree tree_;
    std::vector<double> nearest_;
};

}  // namespace

std::vector<std::vector<Index>> handle_loops(const SeamedMesh& mesh, int base_points, bool all,
                                             ExecutionContext& context)
{
    HandleFinder finder(mesh);
    std::vector<Loop> best;
    Index base = 0;
    for (int i = 0; i < base_points; ++i) {
        context.checkpoint();
        std::vector<Loop> loops = finder.basis(base);
        const bool better = best.empty() || loops.front().length < best.front().length;
        if (better) best = std::move(loops);
        const Index far = finder.farthest();
        base = better ? origin(mesh.fans, best.front().halfedges.front()) : far;
    }
    std::vector<char> taken(mesh.fan_count, 0);
    std::vector<std::vector<Index>> chosen;
    for (Loop& loop : best) {
        if (!all && loop.length > about_as_short * best.front().length) break;
        const auto clear = [&](Index h) { return !taken[origin(mesh.fans, h)] && !taken[target(mesh.fans, h)]; };
        if (!std::ranges::all_of(loop.halfedges, clear)) continue;
        for (const Index h : loop.halfedges) taken[origin(mesh.fans, h)] = taken[target(mesh.fans, h)] = 1;
        chosen.push_back(std::move(loop.halfedges));
    }
    return chosen;
}

}  // namespace koebe
