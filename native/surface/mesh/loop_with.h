// Which loop a vertex is on.
#pragma once

#include "core/errors.h"
#include "core/types.h"

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace koebe {

/// The number of the loop with this vertex, -1 without one. @param vertices_of a loop's vertices, for loops that are
/// reports
template <typename Loops, typename Projection = std::identity>
int loop_with(const Loops& loops, Index vertex, Projection vertices_of = {})
{
    const auto holds = [&](const auto& vertices) { return std::ranges::find(vertices, vertex) != vertices.end(); };
    const auto found = std::ranges::find_if(loops, holds, vertices_of);
    return found == loops.end() ? -1 : static_cast<int>(found - loops.begin());
}

/// The number of the loop with this vertex of the input. @param original the input's vertex for each vertex
/// @throws InputError no loop has it
inline std::size_t loop_with_original(const std::vector<VertexLoop>& loops, const std::vector<Index>& original,
                                      Index vertex)
{
    for (std::size_t k = 0; k < loops.size(); ++k)
        for (const Index v : loops[k])
            if (original[v] == vertex) return k;
    throw InputError("vertex " + std::to_string(vertex) + " lies on no boundary loop", ElementKind::vertices, {vertex});
}

}  // namespace koebe
