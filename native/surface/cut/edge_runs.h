// Groups half-edges by their edge.
#pragma once

#include "core/connectivity.h"
#include "core/types.h"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace koebe {

/// Calls visit(half-edges, in ascending order) for every edge. An edge may have any number of half-edges, in either
/// direction.
template <typename Visit>
void for_each_edge(const Triangles& triangles, Index vertex_count, Visit visit)
{
    const Index count = static_cast<Index>(triangles.size());
    const auto low = [&](Index h) { return std::min(origin(triangles, h), target(triangles, h)); };
    const auto high = [&](Index h) { return std::max(origin(triangles, h), target(triangles, h)); };
    std::vector<Index> begin(static_cast<std::size_t>(vertex_count) + 1, 0);
    for (Index h = 0; h < count; ++h) ++begin[low(h) + 1];
    for (Index v = 0; v < vertex_count; ++v) begin[v + 1] += begin[v];
    std::vector<Index> sorted(count), cursor(begin.begin(), begin.end() - 1);
    for (Index h = 0; h < count; ++h) sorted[cursor[low(h)]++] = h;
    for (Index v = 0; v < vertex_count; ++v) {
        const auto first = sorted.begin() + begin[v], last = sorted.begin() + begin[v + 1];
        std::stable_sort(first, last, [&](Index a, Index b) { return high(a) < high(b); });
        for (auto run = first; run != last;) {
            auto end = run + 1;
            while (end != last && high(*end) == high(*run)) ++end;
            visit(std::span<const Index>(&*run, static_cast<std::size_t>(end - run)));
            run = end;
        }
    }
}

}  // namespace koebe
