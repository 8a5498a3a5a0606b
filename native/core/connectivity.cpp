#include "core/connectivity.h"

#include "core/errors.h"

#include <algorithm>
#include <string>

namespace koebe {

std::vector<Index> pair_halfedges(const Triangles& triangles, Index vertex_count)
{
    const Index halfedge_count = static_cast<Index>(triangles.size());

    // Bucket the half-edges by their smaller vertex; a bucket holds at most one fan, so it is short.
    std::vector<Index> bucket_begin(vertex_count + 1, 0);
    for (Index h = 0; h < halfedge_count; ++h) ++bucket_begin[std::min(origin(triangles, h), target(triangles, h)) + 1];
    for (Index v = 0; v < vertex_count; ++v) bucket_begin[v + 1] += bucket_begin[v];

    struct Entry {
        Index other_vertex;
        Index halfedge;
    };
    std::vector<Entry> entries(halfedge_count);
    std::vector<Index> cursor(bucket_begin.begin(), bucket_begin.end() - 1);
    for (Index h = 0; h < halfedge_count; ++h) {
        const Index a = origin(triangles, h), b = target(triangles, h);
        entries[cursor[std::min(a, b)]++] = {std::max(a, b), h};
    }

    std::vector<Index> twin(halfedge_count, no_twin);
    std::vector<Index> nonmanifold;
    for (Index v = 0; v < vertex_count; ++v) {
        const auto begin = entries.begin() + bucket_begin[v];
        const auto end = entries.begin() + bucket_begin[v + 1];
        std::sort(begin, end, [](const Entry& a, const Entry& b) {
            return a.other_vertex != b.other_vertex ? a.other_vertex < b.other_vertex : a.halfedge < b.halfedge;
        });
        for (auto run = begin; run != end;) {
            auto run_end = run + 1;
            while (run_end != end && run_end->other_vertex == run->other_vertex) ++run_end;
            if (run_end - run == 2) {
                twin[run->halfedge] = (run + 1)->halfedge;
                twin[(run + 1)->halfedge] = run->halfedge;
            } else if (run_end - run > 2) {
                nonmanifold.insert(nonmanifold.end(), {v, run->other_vertex});
            }
            run = run_end;
        }
    }
    if (!nonmanifold.empty())
        throw TopologyError(TopologyKind::nonmanifold_edge,
                            std::to_string(nonmanifold.size() / 2) +
                                " edges have more than two faces (vertex pairs listed)",
                            nonmanifold);
    return twin;
}

std::vector<char> unused_vertices(const Triangles& triangles, Index vertex_count)
{
    std::vector<char> unused(vertex_count, 1);
    for (Eigen::Index i = 0; i < triangles.size(); ++i) unused[triangles.data()[i]] = 0;
    return unused;
}

}  // namespace koebe
