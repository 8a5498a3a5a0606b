#include "cut/edge_chains.h"

#include "core/sort_unique.h"

#include <algorithm>

namespace koebe {

std::vector<std::vector<Index>> edge_chains(std::vector<std::pair<Index, Index>> edges)
{
    for (auto& edge : edges) edge = std::minmax({edge.first, edge.second});
    sort_unique(edges);

    struct End {
        Index vertex, other;
        std::size_t edge;
    };
    std::vector<End> ends;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        ends.push_back({edges[e].first, edges[e].second, e});
        ends.push_back({edges[e].second, edges[e].first, e});
    }
    std::ranges::sort(ends, {}, [](const End& end) { return std::pair(end.vertex, end.other); });
    // Number of edge ends at a vertex, and the first of them.
    const auto at = [&](Index v) {
        const auto first = std::ranges::lower_bound(ends, v, {}, &End::vertex);
        return std::pair(std::ranges::upper_bound(ends, v, {}, &End::vertex) - first, first);
    };

    std::vector<char> walked(edges.size(), 0);
    std::vector<std::vector<Index>> chains;
    const auto walk = [&](const End& first) {
        if (walked[first.edge]) return;
        walked[first.edge] = 1;
        std::vector<Index> chain{first.vertex, first.other};
        for (auto next = at(chain.back()); next.first == 2; next = at(chain.back())) {
            const End& end = walked[next.second->edge] ? *std::next(next.second) : *next.second;
            if (walked[end.edge]) break;
            walked[end.edge] = 1;
            chain.push_back(end.other);
        }
        chains.push_back(std::move(chain));
    };
    for (const End& end : ends)
        if (at(end.vertex).first != 2) walk(end);
    for (const End& end : ends) walk(end);
    return chains;
}

}  // namespace koebe
