#include "pipeline/flip_removal.h"

#include "flaps/flap_map.h"
#include "pipeline/normalization.h"

#include <algorithm>
#include <utility>

namespace koebe {

CircleMap hang_back(const Domain& whole, const FlapCut& cut, CircleMap map, ExecutionContext& context)
{
    if (cut.flaps.empty()) return map;
    const PlanarPoints core_uv = std::move(map.uv);
    map.uv = PlanarPoints::Zero(whole.vertices.rows(), 2);
    map.uv(cut.vertices, Eigen::all) = core_uv;
    map.off_circle = hang_flaps(whole.vertices, whole.surface.triangles, cut.flaps, whole.loops, map.uv, context);
    std::sort(map.off_circle.begin(), map.off_circle.end());
    return map;
}

UntangleReport remove_flips(const Domain& whole, CircleMap& map, ExecutionContext& context)
{
    UntangleReport report = untangle(whole.vertices, whole.surface, whole.loops, map.circles, map.off_circle, map.uv,
                                     context, {.held = held_vertices(whole)});
    map.off_circle.insert(map.off_circle.end(), report.freed.begin(), report.freed.end());
    std::sort(map.off_circle.begin(), map.off_circle.end());
    return report;
}

}  // namespace koebe
