#include "tiles/tile.h"

#include "core/connectivity.h"
#include "core/numbering.h"
#include "core/uv_resolution.h"
#include "planar/boundary_crossings.h"
#include "tiles/tile_cut.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace koebe {
namespace {

constexpr double grid_extent = 16777216.0 - 64.0;  // leaves room for rounding

GridPoint on_grid(Complex z, double scale) { return {std::llround(scale * z.real()), std::llround(scale * z.imag())}; }

std::int64_t twice_area(GridPoint a, GridPoint b) { return a[0] * b[1] - a[1] * b[0]; }
GridPoint difference(GridPoint a, GridPoint b) { return {a[0] - b[0], a[1] - b[1]}; }

}  // namespace

Tile tile_of(const PeriodicSurface& domain, const FlatMap& map)
{
    return tile_of(domain, map, clear_origin(domain, map));
}

Tile tile_of(const PeriodicSurface& domain, const FlatMap& map, std::array<double, 2> origin)
{
    Tile tile;
    tile.lift = cut_tile(domain, map, origin);
    const Triangles& triangles = domain.surface.triangles;
    // The tile's box, by which it is scaled onto the grid.
    Complex low(1e300, 1e300), high(-1e300, -1e300);
    for (Eigen::Index c = 0; c < triangles.size(); ++c) {
        const Complex at = lifted(map, map.z[triangles.data()[c]], tile.lift[c]);
        low = {std::min(low.real(), at.real()), std::min(low.imag(), at.imag())};
        high = {std::max(high.real(), at.real()), std::max(high.imag(), at.imag())};
    }
    const double scale = grid_extent / std::max((high - low).real(), (high - low).imag());
    // Periods and places on the grid: copies then fit to the bit, as they are sums of whole numbers.
    for (const Complex period : map.periods) tile.periods.push_back(on_grid(period, scale));
    GridPoint least{std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::max()};
    for (Eigen::Index c = 0; c < triangles.size(); ++c) {
        GridPoint at = on_grid(map.z[triangles.data()[c]] - low, scale);
        for (std::size_t j = 0; j < tile.periods.size(); ++j)
            for (std::size_t i = 0; i < 2; ++i) at[i] += tile.lift[c][j] * tile.periods[j][i];
        tile.corners.push_back(at);
        least = {std::min(least[0], at[0]), std::min(least[1], at[1])};
    }
    // The box begins at 0.
    for (GridPoint& at : tile.corners) at = difference(at, least);
    tile.scale = scale * uv_grid;
    tile.origin = -tile.scale * low - uv_grid * Complex(static_cast<double>(least[0]), static_cast<double>(least[1]));
    for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h)
        if (is_seam(domain, tile.lift, h)) tile.seams.push_back(h);
    return tile;
}

TileFaults find_faults(const PeriodicSurface& domain, const Tile& tile, HoleShape holes)
{
    TileFaults faults;
    const Triangles& triangles = domain.surface.triangles;
    const auto edge = [&](Index h) { return difference(tile.corners[next_halfedge(h)], tile.corners[h]); };
    constexpr double resolution = uv_resolution / uv_grid;
    std::int64_t covered = 0;
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f) {
        const std::int64_t area = twice_area(edge(3 * f), edge(3 * f + 1));
        covered += area;
        if (area > 0) continue;
        faults.flipped.push_back(f);
        double longest = 0.0;
        for (Index h = 3 * f; h < 3 * f + 3; ++h)
            longest = std::max(longest, std::hypot(static_cast<double>(edge(h)[0]), static_cast<double>(edge(h)[1])));
        if (longest < resolution) faults.below_resolution.push_back(f);
    }
    for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h)
        if (const Index t = domain.surface.twin[h]; t > h) {
            const GridPoint a = edge(h), b = edge(t);
            faults.seams |= a[0] + b[0] != 0 || a[1] + b[1] != 0;
        }
    // Follow holes along their edges, even where the tile has cut them.
    std::vector<Index> border(domain.surface.vertex_count, -1);
    for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h)
        if (domain.surface.twin[h] == no_twin) border[origin(triangles, h)] = h;
    std::int64_t cell = domain.first_hole == 0 ? 2 * twice_area(tile.periods[0], tile.periods[1]) : 0;
    std::array<std::int64_t, 2> lowest{0, 0}, highest{0, 0};  // of the rims
    for (std::size_t k = 0; k < domain.loops.size(); ++k) {
        const VertexLoop& loop = domain.loops[k];
        const bool rim = k < domain.first_hole;
        PlanarPoints points(static_cast<Eigen::Index>(loop.size()), 2);
        GridPoint at{0, rim ? tile.corners[border[loop.front()]][1] : 0};
        const GridPoint start = at;
        if (rim) lowest[k] = highest[k] = at[1];
        std::int64_t area = 0, under = 0;  // twice
        bool bad = false;
        for (std::size_t b = 0; b < loop.size(); ++b) {
            points.row(static_cast<Eigen::Index>(b)) << static_cast<double>(at[0]), static_cast<double>(at[1]);
            const GridPoint step = edge(border[loop[b]]), next{at[0] + step[0], at[1] + step[1]};
            area += twice_area(at, next);
            under += step[0] * (at[1] + next[1]);
            bad |= rim && (k == 0 ? step[0] <= 0 : step[0] >= 0);  // each rim runs one way
            at = next;
            if (rim) lowest[k] = std::min(lowest[k], at[1]), highest[k] = std::max(highest[k], at[1]);
        }
        if (rim) {
            bad |= at[0] != (k == 0 ? tile.periods[0][0] : -tile.periods[0][0]) || at[1] != start[1];
            cell -= under;
        } else {
            bad |= at != start;
            covered -= area;  // it runs clockwise
            if (holes != HoleShape::open) {
                bad |= points.col(holes == HoleShape::along_u ? 1 : 0).cwiseAbs().maxCoeff() > 0.0;
            } else {
                VertexLoop order = numbers_below(loop.size());
                bad |= area > 0 || loops_cross({order}, points, 2.0 * resolution);
            }
        }
        if (bad) faults.holes.push_back(static_cast<int>(k));
    }
    if (domain.first_hole > 0 && lowest[1] <= highest[0]) faults.holes.push_back(1);
    faults.covering = covered != cell;
    return faults;
}

}  // namespace koebe
