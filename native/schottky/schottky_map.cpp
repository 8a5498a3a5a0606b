#include "schottky/schottky_map.h"

#include "balance/area_balance.h"
#include "canonical/corner_map.h"
#include "core/counted.h"
#include "core/errors.h"
#include "execution/memory_limit.h"
#include "execution/stopwatch.h"
#include "linear/dense_spd.h"
#include "quality/map_clock.h"
#include "quality/shared_warnings.h"
#include "quality/stored_uv.h"
#include "quality/take_verdict.h"
#include "schottky/circle_cut.h"
#include "schottky/finer_faces.h"
#include "schottky/glued_state.h"
#include "schottky/schottky_tile.h"
#include "surface/intrinsic_metric.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace koebe {
namespace {

constexpr Index balanced_faces = 20000;  // that are looked at for it
constexpr double least_circle = 1e-12;   // of a circle whose points 64-bit coordinates tell apart
constexpr double large_misfit = 0.5;
constexpr double equal_radii = 1e-6;  // a smaller difference, over the radius, is rounding
constexpr double worst_spread = 1e3;  // worse than any where circles are apart
constexpr Index enough_faces = 6000;  // a surface of fewer is split finer, at most so many times:
constexpr int most_levels = 2;
constexpr int circle_cuts = 2;  // after the first along edges

std::vector<Index> all_loop_vertices(const HandleCut& cut)
{
    std::vector<Index> result;
    for (const CutLoop& loop : cut.loops) result.insert(result.end(), loop.vertices.begin(), loop.vertices.end());
    return result;
}

/// The inside harmonic between the loops. These were moved a little, onto circles and to fit each other: without a
/// shift a flux would run to the smallest of them, and be all that the map is near there.
void fill_inside(CondensedLaplacian& surface, const GluedState& state, SchottkyPlane& plane)
{
    plane.shift(state.shifts_without_flux(plane.images));
    Eigen::Index count = 0, row = 0;
    for (const VectorXcd& image : plane.images) count += image.size();
    MatrixXd boundary(count, 2);
    for (const VectorXcd& image : plane.images) {
        boundary.middleRows(row, image.size()) << image.real(), image.imag();
        row += image.size();
    }
    const MatrixXd z = surface.extend(boundary);
    plane.z = z.col(0) + Complex(0.0, 1.0) * z.col(1);
}

PlanarPoints as_points(const VectorXcd& z)
{
    PlanarPoints points(z.size(), 2);
    points << z.real(), z.imag();
    return points;
}

/// With holes: the automorphism of the disk with the most even texels, or the nearest one with room for equal circles.
/// The loops are solved for anew, not moved: where a handle's loops are tiny, a flux of the size of the mesh's errors
/// would draw all of them to one side.
SchottkyPlane plane_in_disk(const HandleCut& cut, CondensedLaplacian& surface, const GluedState& state,
                            SchottkyNormalization normalization)
{
    const VectorXcd rim = state.rim();
    SchottkyPlane plane = schottky_plane(cut, state.images_in_disk(rim));
    fill_inside(surface, state, plane);
    double left = 0.0;
    const Moebius even = least_area_distortion(
        face_scales(cut.vertices, cut.surface.triangles, as_points(plane.z), balanced_faces), left);
    plane = schottky_plane(cut, state.images_in_disk(even(rim)));
    if (normalization == SchottkyNormalization::circles)
        plane = schottky_plane(cut, state.images_in_disk(nearest_with_room(plane)(even(rim))));
    fill_inside(surface, state, plane);
    return plane;
}

/// Without holes: of the handles whose generator can be z -> lambda z the one with the most even texels.
SchottkyPlane annular_plane(const HandleCut& cut, CondensedLaplacian& surface, const GluedState& state)
{
    SchottkyPlane plane = schottky_plane(cut, state.images_round_infinity());
    fill_inside(surface, state, plane);
    SchottkyPlane best;
    double least = std::numeric_limits<double>::infinity();
    for (int handle = 0; handle < cut.handles; ++handle) {
        SchottkyPlane tried = plane;
        make_annular(tried, handle);
        SchottkyPlane scaled = tried;
        const bool apart = fundamental_circles(scaled).apart;
        const double spread = measure_distortion(cut.vertices, cut.surface.triangles, as_points(tried.z)).area.log_sd +
                              (apart ? 0.0 : worst_spread);
        if (handle > 0 && !(spread < least)) continue;
        least = spread;
        best = std::move(tried);
    }
    return best;
}

/// (3F, 2) by the input's faces: a turned one has its second and third corner the other way round.
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
    warn_reoriented(result.turned, result.warnings);
    if (!iterated)
        result.warnings.push_back(
            {WarningKind::not_converged,
             "the loops still moved after " + counted(static_cast<std::size_t>(result.sweeps), "sweep")});
    if (!circles.apart)
        result.warnings.push_back(
            {WarningKind::no_circles, "circles of the handles meet each other or a hole: the UVs are cut along edges"});
    else if (const auto unequal = std::ranges::count_if(result.handles, unequal_circles);
             unequal > 0 && normalization == SchottkyNormalization::circles)
        result.warnings.push_back({WarningKind::no_circles, "equal circles have no room in any position that was "
                                                            "tried: those of " +
                                                                counted(static_cast<std::size_t>(unequal), "handle") +
                                                                " differ"});
    if (std::ranges::any_of(result.handles, [](const SchottkyHandle& handle) { return handle.misfit > large_misfit; }))
        result.warnings.push_back({WarningKind::coarse_mesh,
                                   "the sides of a handle's cut miss each other by half of their radius and more: the "
                                   "faces are too large there"});
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

/// A cut surface and its map.
struct CutMap {
    HandleCut cut;
    SchottkyPlane plane;
    FundamentalCircles circles;
    bool converged = false;
    std::vector<double> changes;
};

CutMap map_of(HandleCut cut, const SchottkyOptions& options, StageSeconds& seconds, double from, double until,
              ExecutionContext& context)
{
    Stopwatch stage;
    context.begin_stage("factor", from, from + 0.6 * (until - from));
    CutMap map;
    map.cut = std::move(cut);
    const IntrinsicMetric metric = intrinsic_metric(map.cut.vertices, map.cut.surface);
    const SparseMatrix laplacian =
        cotan_laplacian(metric.triangles, half_cotangents(metric.lengths), map.cut.surface.vertex_count);
    seconds.metric += stage.lap();
    CondensedLaplacian surface(laplacian, all_loop_vertices(map.cut));
    seconds.factor += stage.lap();
    context.begin_stage("iterate", from + 0.6 * (until - from), until);
    GluedState state(surface, map.cut.loops);
    while (!map.converged && static_cast<int>(map.changes.size()) < options.max_sweeps) {
        context.checkpoint();
        map.changes.push_back(state.sweep());
        map.converged = map.changes.back() < options.tolerance;
        context.advance(1.0 - std::pow(0.6, static_cast<double>(map.changes.size())));
    }
    map.plane = map.cut.holes > 0 ? plane_in_disk(map.cut, surface, state, options.normalization)
                                  : annular_plane(map.cut, surface, state);
    map.circles = fundamental_circles(map.plane);
    seconds.iterate += stage.lap();
    return map;
}

/// A map, put together to the UVs.
struct LaidMap {
    CutMap map;
    SchottkyTile tile;
    SchottkyFaults faults;
    bool by_circles = false;

    bool tangled() const { return faults.flipped.size() > faults.below_resolution.size(); }
    /// So many flips that repairs would take long and leave some.
    bool hopeless() const { return faults.flipped.size() > faults.below_resolution.size() + tile.triangles.rows() / 5; }
};

/// All of it as large as fits into the unit square's scale, |x| and |y| up to 1, and then judged.
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

/// Flipped faces are turned back in tiles that are bounded elsewhere, too: their boundaries are held.
LaidMap laid(CutMap map, const FinerFaces& faces, const std::vector<Index>& polygon, ExecutionContext& context)
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
    // The boundary of the UVs may be wrong on one circle and right on another.
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

/// Maps of the surface cut along edges, and then along circles as long as there are some.
std::vector<CutMap> maps_of(HandleCut cut, const FinerFaces& faces, const SchottkyOptions& options,
                            StageSeconds& seconds, ExecutionContext& context)
{
    std::vector<CutMap> maps;
    maps.push_back(map_of(std::move(cut), options, seconds, 0.15, 0.5, context));
    for (int i = 0; i < circle_cuts && maps.back().circles.apart; ++i) {
        std::optional<HandleCut> again =
            cut_along_circles(maps.back().cut, faces, maps.back().plane, maps.back().circles);
        if (!again) break;
        maps.push_back(map_of(std::move(*again), options, seconds, 0.5 + 0.2 * i, 0.7 + 0.2 * i, context));
    }
    return maps;
}

/// @param finer how often coarse faces are split
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
        throw TopologyError(TopologyKind::genus, "the surface has no handle: a Schottky group needs one at least");
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
    std::vector<CutMap> maps = maps_of(std::move(first), faces, options, of_maps, context);
    clock.take(of_maps);

    context.begin_stage("finish", 0.9, 1.0);
    LaidMap best;
    for (std::size_t i = maps.size(); i-- > 0;) {  // the last one is the best, if it is one to one
        LaidMap laid_map = laid(std::move(maps[i]), faces, options.polygon, context);
        const bool better = i + 1 == maps.size() || !laid_map.faults.any();
        if (better) best = std::move(laid_map);
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
            throw SolverError("a handle is too long beside its girth for a plane: rounding loses its end",
                              ElementKind::vertices, handle.cut);
    }
    result.turned = surface.reoriented;
    result.sweeps = static_cast<int>(best.map.changes.size());
    result.changes = best.map.changes;
    result.distortion = {distortion_of(best.tile, cut), judge_corners(vertices, triangles, result.uv, result.turned)};
    result.converged = best.map.converged && !best.faults.any();
    warn(circles, best.faults, best.map.converged, options.normalization, result);
    clock.finish(result, context);
    return result;
}

/// Where a hole has few vertices, faces that were split leave no room for whole ones beside its chords: then they stay
/// whole.
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
        } catch (const KoebeError&) {  // too coarse to be cut: what there is has to do
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
                 "where equal circles have room the map is not one to one: this is the one of the "
                 "least area distortion"});
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

const char* to_string(SchottkyNormalization normalization) noexcept
{
    return normalization == SchottkyNormalization::area ? "area" : "circles";
}

SchottkyResult schottky_map(const Vertices& vertices, const Triangles& triangles, const SchottkyOptions& options,
                            ExecutionContext& context)
{
    const auto compute = [options](const CanonicalMesh& mesh, ExecutionContext& own) {
        SchottkyOptions here = options;
        here.polygon = mesh.of_faces(options.polygon);
        return schottky_map_here(mesh.vertices, mesh.triangles, here, own);
    };
    return corner_map<SchottkyResult>(vertices, triangles, context, compute, name_schottky);
}

}  // namespace koebe
