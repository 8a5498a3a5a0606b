#include "cli/options/loop_options.h"

#include "cli/options/wrong_usage.h"
#include "core/counted.h"
#include "mesh/loop_with.h"
#include "pipeline/map_input.h"
#include "surface/loop_edges.h"

#include <algorithm>
#include <string>

namespace koebe::cli {

namespace {

void require_vertex(const Surface& surface, Index vertex, const std::string& option)
{
    if (vertex >= surface.vertex_count)
        throw WrongUsage(option + ": there is no vertex " + std::to_string(vertex) + ": the mesh has " +
                         counted(surface.vertex_count, "vertex") + ", numbered from 0");
}

void require_inside(const Surface& surface, Index vertex)
{
    const std::string beginning = "--center: vertex " + std::to_string(vertex);
    if (loop_with(surface.loops, vertex) >= 0) throw WrongUsage(beginning + " lies on a boundary loop");
    if (std::ranges::find(surface.unused, vertex) != surface.unused.end())
        throw WrongUsage(beginning + " belongs to no face");
}

}  // namespace

Index loop_of(const Surface& surface, Index vertex, const std::string& option)
{
    require_vertex(surface, vertex, option);
    const Index loop = loop_with(surface.loops, vertex);
    if (loop < 0) throw WrongUsage(option + ": vertex " + std::to_string(vertex) + " lies on no boundary loop");
    return loop;
}

void require_fitting_vertices(const MeshInput& input, const UniformizeOptions& options)
{
    const bool outer = options.outer == OuterLoop::vertex;
    if (!outer && options.center < 0 && options.point < 0) return;
    const Vertices& vertices = input.polygons.vertices;
    const Surface surface = analyze_surface(input.triangulation.triangles, static_cast<Index>(vertices.rows()));
    if (outer) require_vertex(surface, options.outer_vertex, "--outer");
    require_vertex(surface, options.center, "--center");
    require_vertex(surface, options.point, "--point");
    if (surface.loops.empty()) return;  // a closed surface gets another error
    const Index named = outer ? loop_of(surface, options.outer_vertex) : -1;
    if (options.point >= 0) {
        const Index own = loop_of(surface, options.point, "--point");
        const double length = loop_edges(vertices, surface.loops[own]).sum();
        for (Index k = 0; k < static_cast<Index>(surface.loops.size()); ++k)
            if (k != own &&
                (k == named || (options.outer == OuterLoop::longest &&
                                loop_edges(vertices, surface.loops[k]).sum() > (1.0 + same_length) * length)))
                throw WrongUsage("--point: vertex " + std::to_string(options.point) +
                                 " does not lie on the loop that --outer names");
    }
    if (options.center >= 0) require_inside(surface, options.center);
}

void require_ranks(const std::vector<Index>& ranks, std::size_t loop_count)
{
    for (const Index rank : ranks)
        if (rank >= static_cast<Index>(loop_count))
            throw WrongUsage("--loops: there is no boundary loop " + std::to_string(rank) + ": the surface has " +
                             counted(loop_count, "loop") + ", numbered from 0");
}

}  // namespace koebe::cli
