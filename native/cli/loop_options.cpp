#include "cli/loop_options.h"

#include "cli/wrong_usage.h"

#include <algorithm>
#include <string>

namespace koebe::cli {

Index loop_of(const Surface& surface, Index vertex)
{
    if (vertex >= surface.vertex_count)
        throw WrongUsage("--outer: there is no vertex " + std::to_string(vertex) + " among " +
                         std::to_string(surface.vertex_count) + ", counted from 0");
    const auto holds = [vertex](const VertexLoop& loop) { return std::ranges::find(loop, vertex) != loop.end(); };
    const auto found = std::ranges::find_if(surface.loops, holds);
    if (found == surface.loops.end())
        throw WrongUsage("--outer: vertex " + std::to_string(vertex) + " lies on no boundary loop");
    return static_cast<Index>(found - surface.loops.begin());
}

void require_on_a_loop(const MeshInput& input, Index vertex)
{
    const Index vertex_count = static_cast<Index>(input.polygons.vertices.rows());
    const Surface surface = analyze_surface(input.triangulation.triangles, vertex_count);
    if (!surface.loops.empty() || vertex >= vertex_count) loop_of(surface, vertex);  // closed: another error
}

void require_ranks(const std::vector<Index>& ranks, std::size_t loop_count)
{
    for (const Index rank : ranks)
        if (rank >= static_cast<Index>(loop_count))
            throw WrongUsage("--loops: there is no boundary loop " + std::to_string(rank) + " among " +
                             std::to_string(loop_count) + ", counted from 0");
}

}  // namespace koebe::cli
