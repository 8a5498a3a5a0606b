#include "linear/dense_spd.h"
#include "quality/map_clock.h"
#include "quality/take_verdict.h"
#include "tiles/tile_map.h"
#include "tiles/tile_result.h"
#include "tiles/torus_circles.h"

namespace koebe {
namespace {

TileResult torus_map_here(const Vertices& vertices, const Triangles& triangles, const TileOptions& options,
                          ExecutionContext& context)
{
    fix_product_blocks();
    MapClock clock;
    context.begin_stage("topology", 0.0, 0.1);
    PeriodicSurface domain = periodic_torus(vertices, triangles);
    domain.polygon = options.polygon;
    clock.end(&StageSeconds::topology);
    context.begin_stage("iterate", 0.1, 0.9);
    IterationOptions iteration;
    static_cast<SweepOptions&>(iteration) = options;
    FlatMap map = torus_circles(domain, iteration, context);
    clock.end(&StageSeconds::iterate);
    context.begin_stage("finish", 0.9, 1.0);
    TileResult result = tile_result(vertices, triangles, domain, options, HoleShape::open, map, context);
    result.modulus = map.periods[1] / map.periods[0];
    take_verdict({.most_lost = options.most_lost}, result);
    clock.finish(result, context);
    return result;
}

}  // namespace

TileResult torus_map(const Vertices& vertices, const Triangles& triangles, const TileOptions& options,
                     ExecutionContext& context)
{
    return canonical_tile(vertices, triangles, options, context, torus_map_here);
}

}  // namespace koebe
