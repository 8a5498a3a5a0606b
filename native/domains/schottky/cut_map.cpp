#include "schottky/cut_map.h"

#include "balance/area_balance.h"
#include "execution/stopwatch.h"
#include "schottky/circle_cut.h"
#include "schottky/glued_state.h"
#include "surface/curvature_weights.h"

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace koebe {
namespace {

constexpr Index balanced_faces = 20000;  // number of faces used to balance
constexpr double worst_spread = 1e3;     // worse than all maps with circles apart
constexpr int circle_cuts = 2;           // after the first along edges

std::vector<Index> all_loop_vertices(const HandleCut& cut)
{
    std::vector<Index> result;
    for (const CutLoop& loop : cut.loops) result.insert(result.end(), loop.vertices.begin(), loop.vertices.end());
    return result;
}

/// Makes the inside harmonic between the loops. First shifts the loops, which were moved a little onto circles and to
/// fit each other: otherwise a flux would run to the smallest loop and dominate the map there.
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

/// With holes: applies the automorphism of the disk with the most even texels, or the nearest one with room for equal
/// circles. The loops are solved for again, not moved: for a handle's tiny loops, a flux as large as the mesh's errors
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

/// Without holes: of the handles whose generator can be z -> lambda z, takes the one with the most even texels.
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

CutMap map_of(HandleCut cut, const SchottkyOptions& options, StageSeconds& seconds, double from, double until,
              ExecutionContext& context)
{
    Stopwatch stage;
    context.begin_stage("factor", from, from + 0.6 * (until - from));
    CutMap map;
    map.cut = std::move(cut);
    const IntrinsicMetric metric = intrinsic_metric(map.cut.vertices, map.cut.surface);
    const SparseMatrix laplacian = cotan_laplacian(
        metric.triangles, curvature_weights(metric, map.cut.surface.vertex_count), map.cut.surface.vertex_count);
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

}  // namespace

std::vector<CutMap> cut_maps(HandleCut cut, const FinerFaces& faces, const SchottkyOptions& options,
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

}  // namespace koebe
