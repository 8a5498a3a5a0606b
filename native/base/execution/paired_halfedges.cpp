// The half-edges of core/connectivity.h, paired on several threads, which core does not know.
#include "core/connectivity.h"
#include "core/errors.h"
#include "execution/thread_share.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace koebe {
namespace {

/// A half-edge in the bucket of its smaller vertex.
struct Entry {
    Index other_vertex;
    Index halfedge;

    bool operator<(const Entry& other) const
    {
        return other_vertex != other.other_vertex ? other_vertex < other.other_vertex : halfedge < other.halfedge;
    }
};

/// A bucket holds one fan at most, so nearly all buckets are short.
void sort_bucket(Entry* first, Entry* last)
{
    constexpr std::ptrdiff_t few = 24;
    if (last - first > few) return std::sort(first, last);
    for (Entry* next = first; next != last; ++next) {
        const Entry entry = *next;
        Entry* place = next;
        for (; place != first && entry < *(place - 1); --place) *place = *(place - 1);
        *place = entry;
    }
}

}  // namespace

std::vector<Index> pair_halfedges(const Triangles& triangles, Index vertex_count)
{
    const Index halfedge_count = static_cast<Index>(triangles.size());

    // Bucket the half-edges by their smaller vertex.
    std::vector<Index> bucket_begin(vertex_count + 1, 0);
    const auto each_edge_of = [&](std::size_t begin, std::size_t end, const auto& work) {
        for (Index f = 0; f < halfedge_count; f += 3)
            for (Index k = 0; k < 3; ++k) {
                const Index a = triangles.data()[f + k], b = triangles.data()[f + (k + 1) % 3], least = std::min(a, b);
                if (least >= static_cast<Index>(begin) && least < static_cast<Index>(end))
                    work(least, std::max(a, b), f + k);
            }
    };
    in_ranges(static_cast<std::size_t>(vertex_count), [&](std::size_t begin, std::size_t end) {
        each_edge_of(begin, end, [&](Index least, Index, Index) { ++bucket_begin[least + 1]; });
    });
    for (Index v = 0; v < vertex_count; ++v) bucket_begin[v + 1] += bucket_begin[v];

    const auto entries = std::make_unique_for_overwrite<Entry[]>(static_cast<std::size_t>(halfedge_count));
    std::vector<Index> cursor(bucket_begin.begin(), bucket_begin.end() - 1);
    in_ranges(static_cast<std::size_t>(vertex_count), [&](std::size_t begin, std::size_t end) {
        each_edge_of(begin, end, [&](Index least, Index other, Index h) { entries[cursor[least]++] = {other, h}; });
    });

    std::vector<Index> twin(halfedge_count, no_twin);
    const std::vector<Index> crowded = found_in_pieces(vertex_count, [&](Index v) {
        bool any = false;
        Entry* const begin = entries.get() + bucket_begin[v];
        Entry* const end = entries.get() + bucket_begin[v + 1];
        sort_bucket(begin, end);
        for (Entry* run = begin; run != end;) {
            Entry* run_end = run + 1;
            while (run_end != end && run_end->other_vertex == run->other_vertex) ++run_end;
            if (run_end - run == 2) {
                twin[run->halfedge] = (run + 1)->halfedge;
                twin[(run + 1)->halfedge] = run->halfedge;
            } else if (run_end - run > 2) {
                any = true;
            }
            run = run_end;
        }
        return any;
    });
    std::vector<Index> nonmanifold;
    for (const Index v : crowded)
        for (Index e = bucket_begin[v]; e + 2 < bucket_begin[v + 1]; ++e)
            if (const Index other = entries[e].other_vertex;
                (e == bucket_begin[v] || entries[e - 1].other_vertex != other) && entries[e + 2].other_vertex == other)
                nonmanifold.insert(nonmanifold.end(), {v, other});
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
