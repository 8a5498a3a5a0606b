#include "core/stopwatch.h"
#include "domains/tile_map.h"
#include "domains/tile_result.h"
#include "domains/torus_circles.h"
#include "linear/dense_spd.h"
#include "pipeline/take_verdict.h"

namespace koebe {
namespace {

TileResult torus_map_here(const Vertices& vertices, const Triangles& triangles, const TileOptions& options,
                          ExecutionContext& context)
{
    fix_product_blocks();
    const Stopwatch total;
    Stopwatch stage;
    StageSeconds seconds;
    context.begin_stage("topology", 0.0, 0.1);
    PeriodicSurface domain = periodic_torus(vertices, triangles);
    domain.polygon = options.polygon;
    seconds.topology = stage.lap();
    context.begin_stage("iterate", 0.1, 0.9);
    IterationOptions iteration;
    iteration.tolerance = options.tolerance;
    iteration.max_sweeps = options.max_sweeps;
    FlatMap map = torus_circles(domain, iteration, context);
    seconds.iterate = stage.lap();
    context.begin_stage("finish", 0.9, 1.0);
    TileResult result = tile_result(vertices, triangles, domain, HoleShape::open, map, context);
    result.modulus = map.periods[1] / map.periods[0];
    take_verdict({.most_lost = options.most_lost}, result);
    seconds.finish = stage.lap();
    seconds.total = total.elapsed();
    result.seconds = seconds;
    context.advance(1.0);
    return result;
}

}  // namespace

TileResult torus_map(const Vertices& vertices, const Triangles& triangles, const TileOptions& options,
                     ExecutionContext& context)
{
    return canonical_tile(vertices, triangles, options, context, torus_map_here);
}

}  // namespace koebe
