#include "report/edge_trails.h"

#include <cstddef>

namespace koebe {
namespace {

/// The edges at each vertex, as a compressed adjacency list.
struct Incidence {
    std::vector<std::size_t> begin;
    std::vector<std::size_t> edge;

    Incidence(const std::vector<Edge>& edges, Index vertex_count) : begin(vertex_count + 1, 0), edge(2 * edges.size())
    {
        for (const Edge& e : edges)
            for (const Index v : e) ++begin[v + 1];
        for (Index v = 0; v < vertex_count; ++v) begin[v + 1] += begin[v];
        std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
        for (std::size_t e = 0; e < edges.size(); ++e)
            for (const Index v : edges[e]) edge[next[v]++] = e;
    }
    std::size_t degree(Index v) const { return begin[v + 1] - begin[v]; }
};

}  // namespace

std::vector<std::vector<Index>> edge_trails(const std::vector<Edge>& edges, Index vertex_count)
{
    const Incidence incidence(edges, vertex_count);
    std::vector<std::size_t> next(incidence.begin.begin(), incidence.begin.end() - 1);
    std::vector<char> used(edges.size(), 0);
    std::vector<std::vector<Index>> trails;

    const auto take_edge = [&](Index v) -> const Edge* {
        while (next[v] < incidence.begin[v + 1]) {
            const std::size_t e = incidence.edge[next[v]++];
            if (used[e]) continue;
            used[e] = 1;
            return &edges[e];
        }
        return nullptr;
    };
    const auto walk_from = [&](Index start) {
        Index v = start;
        const Edge* edge = take_edge(v);
        if (!edge) return false;
        std::vector<Index>& trail = trails.emplace_back(1, start);
        for (; edge; edge = take_edge(v)) {
            v = (*edge)[0] == v ? (*edge)[1] : (*edge)[0];
            trail.push_back(v);
        }
        return true;
    };
    // A trail ends only at vertices of odd degree: these begin, and closed trails are left (Euler 1736).
    for (Index v = 0; v < vertex_count; ++v)
        if (incidence.degree(v) % 2 == 1) walk_from(v);
    for (Index v = 0; v < vertex_count; ++v)
        while (walk_from(v)) {
        }
    return trails;
}

}  // namespace koebe
