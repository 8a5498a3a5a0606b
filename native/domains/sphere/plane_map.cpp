#include "sphere/plane_map.h"

#include "mesh/loop_with.h"
#include "pipeline/loop_numbers.h"
#include "pipeline/uniformize.h"
#include "sphere/closed_sphere.h"

#include <algorithm>
#include <string>
#include <utility>

namespace koebe {
namespace {

PlaneMap holed_plane_map(const Vertices& vertices, const Triangles& triangles, const PeriodicSurface& domain,
                         const SphereOptions& options, ExecutionContext& context)
{
    UniformizeOptions map_options;
    map_options.outer = OuterLoop::longest;
    map_options.threads = options.threads;
    static_cast<SweepOptions&>(map_options) = options;
    map_options.most_lost = 1.0;  // the sphere has its own verdict
    const UniformizeResult disk = uniformize_here(vertices, triangles, map_options, context);
    PlaneMap map;
    map.z.resize(domain.surface.vertex_count);
    std::vector<Index> number(static_cast<std::size_t>(vertices.rows()), -1);
    for (Index v = 0; v < domain.surface.vertex_count; ++v) {
        number[domain.original[v]] = v;
        map.z[v] = {disk.uv(domain.original[v], 0), disk.uv(domain.original[v], 1)};
    }
    std::vector<const LoopReport*> report;
    for (std::size_t k = 0; k < domain.loops.size(); ++k) {
        const int found = loop_with(disk.loops, domain.original[domain.loops[k].front()], &LoopReport::vertices);
        const LoopReport& loop = disk.loops.at(found);
        if (found == 0) map.outer = k;
        report.push_back(&loop);
        map.circles.push_back(loop.circle);
        map.roundness.push_back(loop.roundness);
        for (const Index v : loop.off_circle) map.off_circle.push_back(number[v]);
    }
    std::ranges::sort(map.off_circle);
    for (Ear& ear : cut_ears(domain.vertices, domain.surface, domain.loops).ears)
        if (ear.loop == static_cast<int>(map.outer)) map.ears.push_back(std::move(ear));
    map.converged = disk.converged;
    map.sweeps = disk.sweeps;
    map.seconds = disk.seconds;
    for (const KoebeStep& step : disk.history) map.changes.push_back(step.change);
    map.warnings =
        with_loops_renumbered(disk, report,
                              {WarningKind::below_resolution, WarningKind::flipped, WarningKind::not_one_to_one,
                               WarningKind::reoriented_faces, WarningKind::off_circle, WarningKind::unused_vertices,
                               WarningKind::coarse_mesh});
    return map;
}

PlaneMap closed_plane_map(const PeriodicSurface& domain, const VectorXd& weights, const SphereOptions& options,
                          ExecutionContext& context)
{
    IterationOptions iteration;
    static_cast<SweepOptions&>(iteration) = options;
    ClosedSphereMap closed = closed_sphere_map(domain, weights, iteration, context);
    PlaneMap map;
    map.z = std::move(closed.z);
    map.converged = closed.converged;
    map.changes = std::move(closed.changes);
    map.seconds = closed.seconds;
    map.sweeps = static_cast<int>(map.changes.size());
    return map;
}

}  // namespace

PlaneMap plane_map(const Vertices& vertices, const Triangles& triangles, const PeriodicSurface& domain,
                   const VectorXd& weights, const SphereOptions& options, ExecutionContext& context)
{
    if (domain.loops.empty()) return closed_plane_map(domain, weights, options, context);
    ExecutionContext own([&](double done, const std::string& name) { context.report(0.1 + 0.7 * done, name); }, {},
                         [&] { context.checkpoint(); });
    return holed_plane_map(vertices, triangles, domain, options, own);
}

}  // namespace koebe
