#include "schottky/laid_map.h"

#include <cmath>
#include <utility>

namespace koebe {
namespace {

/// Scales the tile until |x| and |y| are at most 1, and judges it.
void fit_and_judge(LaidMap& map)
{
    const double largest = map.tile.points.cwiseAbs().maxCoeff();
    if (largest > 1.0 && std::isfinite(largest)) {
        map.tile.points /= largest;
        map.map.plane.move(linear_fractional(1.0 / largest, 0.0, 0.0, 1.0));
        for (auto& pair : map.map.circles.pairs)
            for (Circle& circle : pair) circle = {circle.center / largest, circle.radius / largest};
    }
    map.faults = find_faults(map.tile);
}

}  // namespace

LaidMap laid_map(CutMap map, const FinerFaces& faces, const std::vector<Index>& polygon, ExecutionContext& context)
{
    LaidMap result;
    result.map = std::move(map);
    SchottkyPlane& plane = result.map.plane;
    const FundamentalCircles& circles = result.map.circles;
    const SchottkyTiling tiling(result.map.cut, faces, polygon);
    result.by_circles = circles.apart;
    const auto put_together = [&] {
        result.tile = circles.apart ? tiling.by_circles(plane, circles) : tiling.as_cut(plane);
        fit_and_judge(result);
    };
    const auto repair = [&](const SchottkyTile& tile) {
        tiling.turn_back(tile, plane, context);
        put_together();
    };
    put_together();
    if (result.hopeless()) return result;
    if (result.tangled()) repair(result.tile);
    if (circles.apart)
        for (const double factor : {1.6, 0.6}) {
            if (!result.tangled()) break;
            const FundamentalCircles beside = circles_beside(plane, circles, factor);
            if (beside.apart) repair(tiling.by_circles(plane, beside));
        }
    if (!circles.apart || !result.faults.any()) return result;
    // The boundary of the UVs may have faults for one circle and none for another.
    for (const double factor : {1.6, 0.6, 2.5, 0.4}) {
        const FundamentalCircles beside = circles_beside(plane, circles, factor);
        if (!beside.apart) continue;
        SchottkyTile tile = tiling.by_circles(plane, beside);
        if (find_faults(tile).any()) continue;
        result.tile = std::move(tile);
        result.map.circles = beside;
        fit_and_judge(result);
        return result;
    }
    SchottkyTile by_cut = tiling.as_cut(plane);
    if (find_faults(by_cut).any()) return result;
    result.tile = std::move(by_cut);
    result.by_circles = false;
    fit_and_judge(result);
    return result;
}

}  // namespace koebe
