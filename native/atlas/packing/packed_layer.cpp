#include "packing/packed_layer.h"

#include "core/counted.h"
#include "core/errors.h"
#include "core/grouping.h"
#include "execution/memory_limit.h"
#include "execution/run_on_copies.h"
#include "execution/stopwatch.h"
#include "opened/disk_packing.h"
#include "packing/layer_islands.h"
#include "packing/tile_packing.h"
#include "part_maps/part_mesh.h"
#include "planar/planar_predicates.h"
#include "quality/map_clock.h"
#include "quality/stored_uv.h"
#include "quality/take_verdict.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace koebe {
namespace {

constexpr double least_fullness = 1e-6;  // area over the square of the extent: a thinner island has no area

/// Scales islands so that each has the area of its faces on the surface. Islands without area get the mean scale.
/// @param areas (F) on the surface
void scale_to_areas(std::vector<PackedPiece>& islands, const VectorXd& areas)
{
    double on_surface = 0.0, in_layer = 0.0;
    std::vector<double> factor;
    for (const PackedPiece& island : islands) {
        const double own = areas(island.faces).sum(), extent = island.points.maxCoeff();
        const bool has_area = own > 0.0 && island.area > least_fullness * extent * extent;
        factor.push_back(has_area ? std::sqrt(own / island.area) : 0.0);
        if (!has_area) continue;
        on_surface += own;
        in_layer += island.area;
    }
    const double mean = in_layer > 0.0 ? std::sqrt(on_surface / in_layer) : 1.0;
    for (std::size_t k = 0; k < islands.size(); ++k) {
        const double own = factor[k] > 0.0 ? factor[k] : mean;
        islands[k].points *= own;
        islands[k].area *= own * own;
    }
}

/// The surface's vertices, scaled so that no square overflows.
Vertices of_size_one(const Vertices& vertices)
{
    const double most = vertices.size() > 0 ? vertices.cwiseAbs().maxCoeff() : 0.0;
    return most > 0.0 ? Vertices(vertices / most) : vertices;
}

/// The outlines of the islands that move, in a unit in which no number is over 1.
struct MovedOutlines {
    std::vector<std::size_t> island;
    std::vector<Outline> outlines;
    double unit = 1.0;  ///< in that of the islands
};

MovedOutlines outlines_in_unit(const std::vector<PackedPiece>& islands)
{
    MovedOutlines moved;
    double most = 0.0;
    for (const PackedPiece& island : islands)
        if (!island.is_locked) most = std::max(most, island.points.maxCoeff());
    if (most > 0.0) moved.unit = most;
    for (std::size_t k = 0; k < islands.size(); ++k) {
        if (islands[k].is_locked) continue;
        moved.island.push_back(k);
        moved.outlines.push_back(islands[k].outline);
        moved.outlines.back().points = islands[k].points / moved.unit;
    }
    return moved;
}

/// The islands that keep their place, as seen from the corner of each tile that they touch.
std::vector<std::vector<Outline>> taken_places(const std::vector<PackedPiece>& islands, const LayerVertices& layer,
                                               int tiles)
{
    std::vector<std::vector<Outline>> taken(static_cast<std::size_t>(tiles));
    for (const PackedPiece& island : islands) {
        if (!island.is_locked) continue;
        const PlanarPoints points = layer.unit * layer.points(island.vertices, Eigen::all);
        for (int tile = 0; tile < tiles; ++tile) {
            Outline outline = island.outline;
            outline.points = points.rowwise() - tile_corner(tile);
            if (outline.points.colwise().minCoeff().maxCoeff() <= 1.0 &&
                outline.points.colwise().maxCoeff().minCoeff() >= 0.0)
                taken[static_cast<std::size_t>(tile)].push_back(std::move(outline));
        }
    }
    return taken;
}

/// UV units over the islands' unit before scaling to areas, and texel density of islands that keep their place.
double locked_density(const std::vector<PackedPiece>& islands, const VectorXd& areas, double unit)
{
    double in_layer = 0.0, on_surface = 0.0;
    for (const PackedPiece& island : islands)
        if (island.is_locked) {
            in_layer += island.area;
            on_surface += areas(island.faces).sum();
        }
    return in_layer > 0.0 && on_surface > 0.0 ? unit * std::sqrt(in_layer / on_surface)
                                              : std::numeric_limits<double>::infinity();
}

void check_layer(const Triangles& triangles, const PackedLayerOptions& options)
{
    if (!options.locked.empty() && options.locked.size() != static_cast<std::size_t>(triangles.rows()))
        throw InputError("there must be a lock for each face");
    if (options.seconds && !(*options.seconds > 0.0 && std::isfinite(*options.seconds)))
        throw InputError("the seconds must be positive");
    if (options.tiles < 1 || options.tiles > most_tiles) throw InputError("tiles must be from 1 to 100");
    if (triangles.rows() == 0) throw InputError("there is no face to pack");
    if (options.uv.rows() != 3 * triangles.rows()) throw InputError("each corner of a face needs u and v");
    std::vector<Index> not_finite;
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f)
        if (!options.uv.middleRows<3>(3 * static_cast<Eigen::Index>(f)).allFinite()) not_finite.push_back(f);
    if (!not_finite.empty()) throw InputError("UVs are NaN or infinite (faces listed)", ElementKind::faces, not_finite);
}

/// Distortion is measured on faces that are turned like their images.
void report_layer_distortion(const Vertices& vertices, Triangles triangles, const PackedLayerOptions& options,
                             PackedLayer& result)
{
    const double lost_before = judge_corners(vertices, triangles, options.uv, result.turned).lost_area;
    const Verdict verdict = judge_corners(vertices, triangles, result.uv, result.turned);
    PlanarPoints points = 2.0 * result.uv.unaryExpr(&as_stored).array() - 1.0;
    for (const Index f : result.turned) {
        std::swap(triangles(f, 1), triangles(f, 2));
        points.row(3 * static_cast<Eigen::Index>(f) + 1).swap(points.row(3 * static_cast<Eigen::Index>(f) + 2));
    }
    result.distortion = {measure_corner_distortion(vertices, triangles, points), verdict};
    result.converged = true;
    if (verdict.lost_area - lost_before > options.most_lost)
        take_verdict(
            {.most_lost = options.most_lost, .advice = "Islands are too small beside the largest: average their scale"},
            result);
}

PackedLayer packed(const Vertices& given, const Triangles& triangles, const PackedLayerOptions& options,
                   ExecutionContext& context)
{
    MapClock clock;
    check_layer(triangles, options);
    require_memory_for_faces(triangles.rows());
    const double margin = margin_in_square(options.margin, options.pixels);
    const Vertices vertices = of_size_one(given);
    // The islands as they are.
    context.begin_stage("topology", 0.0, 0.2);
    const LayerVertices layer = layer_vertices(triangles, options.uv);
    Index count = 0;
    PackedLayer result;
    result.part = islands_of(layer, options.polygon, count);
    std::vector<PackedPiece> islands;
    for (std::vector<Index>& own : places_of_numbers(result.part, count)) {
        context.checkpoint();
        islands.push_back(island_alone(layer, std::move(own)));
        islands.back().is_locked = std::ranges::any_of(
            islands.back().faces, [&](Index f) { return !options.locked.empty() && options.locked[f] > 0.0; });
    }
    const bool any_locked = std::ranges::any_of(islands, &PackedPiece::is_locked);
    double area_before = 0.0, area_after = 0.0;  // of islands that move
    for (const PackedPiece& island : islands)
        if (!island.is_locked) area_before += island.area * layer.unit * layer.unit;
    double as_it_is = layer.unit;  // UV units over the islands' unit, at the size that they have
    if (options.average_scale) {
        const VectorXd areas = face_areas(vertices, triangles);
        if (any_locked) as_it_is = locked_density(islands, areas, layer.unit);
        scale_to_areas(islands, areas);
    }
    clock.end(&StageSeconds::topology);
    // Their places.
    context.begin_stage("pack", 0.2, 1.0);
    const MovedOutlines moved = outlines_in_unit(islands);
    const Stopwatch packing_run;
    const PackingTime time{[&] {
                               const double share = options.seconds ? packing_run.elapsed() / *options.seconds : 0.0;
                               context.advance(share);
                               return share >= 1.0 || options.enough.cancelled();
                           },
                           options.seconds.has_value()};
    TilePacking packing;
    if (any_locked) {
        const PackingSite site{taken_places(islands, layer, options.tiles), as_it_is * moved.unit};
        for (std::size_t tile = 0; tile < site.taken.size(); ++tile)
            if (!site.taken[tile].empty()) result.tiles = static_cast<int>(tile) + 1;
        packing = pack_around(moved.outlines, margin, site, time);
    } else {
        packing = pack_on_tiles(moved.outlines, margin, options.tiles, time);
    }
    clock.end(&StageSeconds::iterate);
    result.uv = options.uv;  // of islands that keep their place
    double area = 0.0;
    for (std::size_t i = 0; i < moved.island.size(); ++i) {
        PackedPiece& island = islands[moved.island[i]];
        const Eigen::RowVector2d corner = tile_corner(packing.tile[i]);
        PlanarPoints places = place_island(moved.outlines[i].points, packing.places[i], packing.scale);
        places = places.cwiseMax(0.0).cwiseMin(1.0).rowwise() + corner;
        result.tiles = std::max(result.tiles, packing.tile[i] + 1);
        area_after += island.area * std::pow(packing.scale / moved.unit, 2);
        for (const Index f : island.faces)
            for (int c = 0; c < 3; ++c) {
                const auto at = std::ranges::lower_bound(island.vertices, layer.faces(f, c)) - island.vertices.begin();
                result.uv.row(3 * static_cast<Eigen::Index>(f) + c) = places.row(at);
            }
    }
    for (PackedPiece& island : islands) {
        if (island.is_mirrored) result.turned.insert(result.turned.end(), island.faces.begin(), island.faces.end());
        result.overlaps += island.overlaps ? 1 : 0;
        result.islands.push_back({std::move(island.faces), island.overlaps, island.is_locked});
    }
    std::ranges::sort(result.turned);
    const PlanarPoints stored = result.uv.unaryExpr(&as_stored);
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) area += std::abs(signed_corner_area(stored, f));
    // The report.
    result.coverage = area / result.tiles;
    if (area_before > 0.0) result.scale = std::sqrt(area_after / area_before);
    result.margin = std::min(options.margin, packing.margin * options.pixels);
    result.vertex_count = static_cast<Index>(vertices.rows());
    result.face_count = static_cast<Index>(triangles.rows());
    report_layer_distortion(vertices, triangles, options, result);
    if (result.overlaps > 0) {
        std::vector<Index> overlapping;
        for (const LayerIsland& island : result.islands)
            if (island.overlaps) overlapping.insert(overlapping.end(), island.faces.begin(), island.faces.end());
        std::ranges::sort(overlapping);
        result.warnings.push_back({WarningKind::not_one_to_one,
                                   counted(static_cast<std::size_t>(result.overlaps), "island") +
                                       " that overlap or touch themselves, as before",
                                   overlapping});
    }
    clock.finish(result, context);
    return result;
}

}  // namespace

PackedLayer pack_layer(const Vertices& vertices, const Triangles& triangles, const PackedLayerOptions& options,
                       ExecutionContext& context)
{
    return run_on_copies<PackedLayer>(context, packed, vertices, triangles, options);
}

}  // namespace koebe
