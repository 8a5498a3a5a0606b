#include "schottky/schottky_map.h"

#include "canonical/corner_map.h"
#include "core/counted.h"
#include "core/errors.h"
#include "execution/execution.h"
#include "execution/memory_limit.h"
#include "foldover/convex_polygons.h"
#include "linear/dense_spd.h"
#include "quality/map_clock.h"
#include "quality/shared_warnings.h"
#include "quality/stored_uv.h"
#include "quality/take_verdict.h"
#include "schottky/cut_map.h"
#include "schottky/finer_faces.h"
#include "schottky/schottky_tile.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace koebe {
namespace {

constexpr double near_sizes[] = {1.6, 0.6};  // of a circle beside the one found, over its radius
constexpr double other_sizes[] = {1.6, 0.6, 2.5, 0.4};

struct LaidMap {
    CutMap map;
    SchottkyTile tile;
    SchottkyFaults faults;
    bool by_circles = false;

    bool tangled() const { return faults.flipped.size() > faults.below_resolution.size(); }
    /// Whether there are so many flips that repairs would take long and leave some.
    bool hopeless() const { return faults.flipped.size() > faults.below_resolution.size() + tile.triangles.rows() / 5; }
};

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

/// Puts a map together. Flipped faces are turned back in tiles with other boundaries, too, as boundaries are held.
/// @param polygon as in SchottkyOptions
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
        for (const double factor : near_sizes) {
            if (!result.tangled()) break;
            const FundamentalCircles beside = circles_beside(plane, circles, factor);
            if (beside.apart) repair(tiling.by_circles(plane, beside));
        }
    if (!circles.apart || !result.faults.any()) return result;
    // The boundary of the UVs may have faults for one circle and none for another.
    for (const double factor : other_sizes) {
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

constexpr double least_circle = 1e-12;  // radius of a circle whose points 64-bit coordinates can tell apart
constexpr double large_misfit = 0.5;
constexpr double equal_radii = 1e-6;  // a smaller difference, over the radius, is rounding
constexpr Index enough_faces = 6000;  // a surface with fewer faces is split, at most so often:
constexpr int most_levels = 2;

/// (3F, 2) in the input's order of faces; in a turned face the second and third corner are exchanged.
PlanarPoints corner_uvs(const Triangles& triangles, const HandleCut& cut, const SchottkyTile& tile)
{
    PlanarPoints uv(triangles.size(), 2);
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const Index vertex = cut.original[tile.vertex[tile.triangles(f, k)]];
            int corner = 0;
            while (triangles(f, corner) != vertex) ++corner;
            const auto at = tile.points.row(tile.triangles(f, k));
            for (int i = 0; i < 2; ++i) uv(3 * f + corner, i) = as_stored(0.5 * (1.0 + at[i]));
        }
    return uv;
}

ComputedDistortion distortion_of(const SchottkyTile& tile, const HandleCut& cut)
{
    Vertices vertices(static_cast<Eigen::Index>(tile.vertex.size()), 3);
    for (std::size_t i = 0; i < tile.vertex.size(); ++i)
        vertices.row(static_cast<Eigen::Index>(i)) = cut.vertices.row(tile.vertex[i]);
    return measure_distortion(vertices, tile.triangles, tile.points);
}

bool unequal_circles(const SchottkyHandle& handle)
{
    const double first = handle.circles[0].radius, second = handle.circles[1].radius;
    return !handle.outer && std::abs(first - second) > equal_radii * std::max(first, second);
}

void warn(const FundamentalCircles& circles, const SchottkyFaults& faults, bool iterated,
          SchottkyNormalization normalization, SchottkyResult& result)
{
    if (!iterated)
        result.warnings.push_back(
            {WarningKind::not_converged,
             "the loops still moved after " + counted(static_cast<std::size_t>(result.sweeps), "sweep")});
    if (!circles.apart)
        result.warnings.push_back(
            {WarningKind::no_circles, "circles of the handles meet each other or a hole: the UVs are cut along edges"});
    else if (const auto unequal = std::ranges::count_if(result.handles, unequal_circles);
             unequal > 0 && normalization == SchottkyNormalization::circles)
        result.warnings.push_back({WarningKind::no_circles, "no position with room for equal circles was found: "
                                                            "the two circles differ for " +
                                                                counted(static_cast<std::size_t>(unequal), "handle")});
    if (std::ranges::any_of(result.handles, [](const SchottkyHandle& handle) { return handle.misfit > large_misfit; }))
        result.warnings.push_back({WarningKind::coarse_mesh,
                                   "the two sides of a handle's cut miss each other by half their radius or more: the "
                                   "faces there are too large"});
    // Of the UVs: loops off their circles, flips, and a boundary that crosses itself.
    std::vector<Index> off_circle;
    for (const SchottkyHole& hole : result.holes)
        off_circle.insert(off_circle.end(), hole.off_circle.begin(), hole.off_circle.end());
    warn_off_circle(std::move(off_circle), result.warnings);
    if (!faults.any()) {
        if (!faults.flipped.empty())
            result.warnings.push_back(
                {WarningKind::below_resolution,
                 counted(faults.flipped.size(), "face") + " flipped where the map is too small for 32-bit UVs",
                 result.distortion.below_resolution});
        return;
    }
    warn_not_one_to_one(result.distortion.flipped, result.distortion.below_resolution,
                        {faults.boundary ? "the boundary of the UVs crosses itself" : ""}, result.warnings);
}

/// @param finer number of times to split coarse faces
SchottkyResult map_split(const Vertices& vertices, const Triangles& triangles, const SchottkyOptions& options,
                         int finer, ExecutionContext& context)
{
    MapClock clock;
    SchottkyResult result;
    result.vertex_count = static_cast<Index>(vertices.rows());
    result.face_count = static_cast<Index>(triangles.rows());
    context.begin_stage("topology", 0.0, 0.15);
    validate_arrays(vertices, triangles);
    require_memory_for_faces(triangles.rows());
    const Surface surface = analyze_surface(triangles, static_cast<Index>(vertices.rows()));
    if (surface.genus == 0)
        throw TopologyError(TopologyKind::genus,
                            "the surface has no handle: a Schottky group needs one at least (a vertex listed)",
                            {surface.triangles(0, 0)});
    const FinerFaces faces = finer_faces(vertices, surface.triangles, enough_faces, finer);
    HandleCut first = cut_handles(faces.vertices, faces.triangles, result.vertex_count, context);
    clock.end(&StageSeconds::topology);
    std::vector<std::vector<Index>> paths;  // of the cuts along edges
    for (std::size_t k = first.holes; k < first.loops.size(); k += 2) {
        std::vector<Index>& path = paths.emplace_back();
        for (const Index v : first.loops[k].vertices)
            if (first.original[v] < result.vertex_count) path.push_back(first.original[v]);
    }
    StageSeconds of_maps;
    std::vector<CutMap> maps = cut_maps(std::move(first), faces, options, of_maps, context);
    clock.take(of_maps);

    context.begin_stage("finish", 0.9, 1.0);
    LaidMap best;
    for (std::size_t i = maps.size(); i-- > 0;) {  // the last one-to-one map is the best
        LaidMap tried = laid_map(std::move(maps[i]), faces, options.polygon, context);
        const bool better = i + 1 == maps.size() || !tried.faults.any();
        if (better) best = std::move(tried);
        if (!best.faults.any()) break;
    }
    const HandleCut& cut = best.map.cut;
    const SchottkyPlane& plane = best.map.plane;
    const FundamentalCircles& circles = best.map.circles;

    result.by_circles = best.by_circles;
    result.uv = corner_uvs(triangles, cut, best.tile);
    for (std::size_t k = 0; k < cut.holes; ++k)
        result.holes.push_back(hole_in(best.tile, plane, cut, k, result.vertex_count));
    for (int j = 0; j < cut.handles; ++j) {
        SchottkyHandle& handle = result.handles.emplace_back();
        handle.cut = paths[j];
        handle.generator = plane.generators[j];
        handle.circles = circles.pairs[j];
        handle.outer = j == plane.outer_handle;
        handle.misfit = plane.misfit[j];
        if (std::min(handle.circles[0].radius, handle.circles[1].radius) < least_circle)
            throw SolverError("a handle is too long for its girth: rounding loses its end", ElementKind::vertices,
                              handle.cut);
    }
    result.turned = surface.reoriented;
    result.sweeps = static_cast<int>(best.map.changes.size());
    result.changes = best.map.changes;
    result.distortion = {distortion_of(best.tile, cut), judge_corners(vertices, triangles, result.uv, result.turned)};
    result.converged = best.map.converged && !best.faults.any();
    warn_reoriented(result.turned, result.warnings);
    warn_inside_out(vertices, surface, result.warnings);
    warn(circles, best.faults, best.map.converged, options.normalization, result);
    warn_concave_polygons({vertices, triangles, options.polygon, result.turned}, result.uv, result.warnings);
    clock.finish(result, context);
    return result;
}

/// At a hole of few vertices split faces may leave no room for whole faces beside its chords. Then faces are not split.
SchottkyResult schottky_map_here(const Vertices& vertices, const Triangles& triangles, const SchottkyOptions& options,
                                 ExecutionContext& context)
{
    fix_product_blocks();
    SchottkyResult result = map_split(vertices, triangles, options, most_levels, context);
    const auto take_if_better = [&](const SchottkyOptions& other, int finer) {
        if (result.converged) return;
        try {
            SchottkyResult own = map_split(vertices, triangles, other, finer, context);
            if (own.converged) result = std::move(own);
        } catch (const Cancelled&) {
            throw;
        } catch (const KoebeError&) {  // too coarse to be cut: use the maps so far
        }
    };
    if (triangles.rows() < enough_faces)
        for (int finer = most_levels; finer-- > 0;) take_if_better(options, finer);
    if (!result.converged && options.normalization == SchottkyNormalization::circles) {
        SchottkyOptions even = options;
        even.normalization = SchottkyNormalization::area;
        take_if_better(even, most_levels);
        if (result.converged)
            result.warnings.push_back(
                {WarningKind::no_circles,
                 "the map with equal circles is not one to one: this is the map of least area distortion instead"});
    }
    take_verdict({.most_lost = options.most_lost}, result);
    return result;
}

void name_schottky(const CanonicalMesh& mesh, SchottkyResult& result)
{
    for (SchottkyHole& hole : result.holes) {
        mesh.name_loop(hole.vertices);
        mesh.name_vertices(hole.off_circle);
    }
    for (SchottkyHandle& handle : result.handles) mesh.name_path(handle.cut);
}

}  // namespace

SchottkyResult schottky_map(const Vertices& vertices, const Triangles& triangles, const SchottkyOptions& options,
                            ExecutionContext& context)
{
    const auto compute = [](const CanonicalMesh& mesh, const SchottkyOptions& here, ExecutionContext& own) {
        return schottky_map_here(mesh.vertices, mesh.triangles, here, own);
    };
    return corner_map<SchottkyResult>(vertices, triangles, options, context, compute, name_schottky);
}

}  // namespace koebe
