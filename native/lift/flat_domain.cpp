#include "lift/flat_domain.h"

#include "mesh/corner_order.h"
#include "parts/parts.h"
#include "pipeline/uniformize.h"
#include "tiles/tile.h"
#include "tiles/tile_map.h"

#include <algorithm>
#include <utility>

namespace koebe {
namespace {

PlanarPoints disk_corners(const Surface& surface, const PlanarPoints& disk)
{
    PlanarPoints uv(surface.triangles.size(), 2);
    for (Eigen::Index c = 0; c < uv.rows(); ++c)
        uv.row(c) = 0.5 * (disk.row(surface.triangles.data()[c]).array() + 1.0).matrix();
    return uv;
}

}  // namespace

FlatDomain flat_domain(const Vertices& vertices, const Triangles& triangles, const LiftOptions& options,
                       ExecutionContext& context)
{
    validate_arrays(vertices, triangles);
    FlatDomain domain;
    domain.surface = analyze_surface(triangles, static_cast<Index>(vertices.rows()));
    PlanarPoints uv;
    double grid = 0.0;
    std::vector<Complex> periods;
    if (options.shape == LiftShape::disk) {
        UniformizeOptions chosen;
        chosen.even = options.even.value_or(0.0);
        UniformizeResult map = uniformize(vertices, triangles, chosen, context);
        uv = disk_corners(domain.surface, map.uv);
        domain.map = std::move(map);
    } else if (options.shape == LiftShape::parts) {
        PartsOptions chosen;
        chosen.even = options.even;
        PartsResult map = parts_of(vertices, triangles, chosen, context);
        uv = in_corner_order(map.uv, triangles, domain.surface.triangles);
        domain.map = std::move(map);
    } else {
        TileOptions chosen;
        chosen.even = options.even.value_or(0.0);
        TileResult map = options.shape == LiftShape::ring ? ring_map(vertices, triangles, chosen, context)
                                                          : torus_map(vertices, triangles, chosen, context);
        uv = in_corner_order(map.uv, triangles, domain.surface.triangles);
        for (const auto& period : map.periods) periods.emplace_back(period[0], period[1]);
        grid = uv_grid;
        domain.map = std::move(map);
    }
    domain.sheet = flat_sheet(vertices, domain.surface.triangles, uv, grid, std::move(periods));
    return domain;
}

}  // namespace koebe
