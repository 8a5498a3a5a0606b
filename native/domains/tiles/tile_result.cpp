#include "tiles/tile_result.h"

#include "canonical/corner_map.h"
#include "circles/on_circle.h"
#include "core/connectivity.h"
#include "core/counted.h"
#include "core/numbering.h"
#include "core/uv_resolution.h"
#include "core/vertex_weights.h"
#include "even/even_map.h"
#include "execution/execution.h"
#include "foldover/convex_polygons.h"
#include "mesh/corner_order.h"
#include "planar/planar_predicates.h"
#include "quality/shared_warnings.h"
#include "surface/importance.h"
#include "surface/periodic_surface.h"
#include "tiles/flat_map.h"
#include "tiles/tile_map.h"
#include "tiles/tile_repair.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace koebe {
namespace {

/// The lifts of each face's corners, from its first half-edge on.
CornerLifts lifts_of(const PeriodicSurface& domain)
{
    CornerLifts lifts(static_cast<std::size_t>(domain.surface.triangles.rows()));
    for (std::size_t f = 0; f < lifts.size(); ++f)
        for (int k = 1; k < 3; ++k) {
            const std::array<int, 2> step = domain.shift(static_cast<Index>(3 * f) + k - 1);
            for (int j = 0; j < 2; ++j) lifts[f][k][j] = lifts[f][k - 1][j] + step[j];
        }
    return lifts;
}

double image_area(const PeriodicSurface& domain, const CornerLifts& lifts, const PlanarPoints& points,
                  const std::vector<Complex>& periods)
{
    double sum = 0.0;
    for (Eigen::Index f = 0; f < domain.surface.triangles.rows(); ++f) {
        const CornerPlaces at = corners_of(points, domain.surface.triangles, lifts, periods, f);
        sum += 0.5 * cross(at[1] - at[0], at[2] - at[0]);
    }
    return sum;
}

std::vector<RoundLoop> round_loops(const PeriodicSurface& domain, LoopForm loops, const VectorXcd& z)
{
    std::vector<RoundLoop> round;
    for (std::size_t k = 0; k < domain.loops.size(); ++k) {
        const bool is_rim = k < domain.first_hole;
        if (!is_rim && loops == LoopForm::free) break;
        RoundLoop& loop = round.emplace_back(RoundLoop{domain.loops[k], {}});
        loop.track.straight = is_rim;
        if (is_rim)
            loop.track.point = z[domain.loops[k].front()];
        else
            loop.track.circle = fit_circle_least_squares(z(domain.loops[k]));
    }
    return round;
}

/// Whether the circles of holes lie between the rims, and apart from each other and their copies.
bool are_apart(std::size_t first_hole, const std::vector<Track>& tracks, const std::vector<Complex>& periods)
{
    std::vector<Circle> circles;
    for (std::size_t k = first_hole; k < tracks.size(); ++k) circles.push_back(tracks[k].circle);
    for (std::size_t rim = 0; rim < first_hole; ++rim)
        for (const Circle& circle : circles)
            if (!(std::abs(circle.center.imag() - tracks[rim].point.imag()) > circle.radius)) return false;
    return apart_in_tile(circles, periods);
}

/// Relaxes the map and its periods (even/even_map.h). The rims of a ring stay straight. Round holes lie on circles of
/// the plane, free holes have no circles. A vertex that cannot be brought to its circle counts as off it.
/// @param options even above 0; importance by the vertices of the input
/// @param map changed in place @return whether it was relaxed; if not, the map is unchanged
bool make_tile_even(const PeriodicSurface& domain, const TileOptions& options, FlatMap& map, ExecutionContext& context)
{
    const CornerLifts lifts = lifts_of(domain);
    PlanarPoints points(map.z.size(), 2);
    points << map.z.real(), map.z.imag();
    const double scale =
        scale_to_size(domain.vertices, domain.surface.triangles, image_area(domain, lifts, points, map.periods));
    if (!std::isfinite(scale) || !(scale > 0.0)) return false;
    points *= scale;
    std::vector<Complex> periods;
    for (const Complex period : map.periods) periods.push_back(scale * period);
    std::vector<RoundLoop> round = round_loops(domain, options.loops, scale * map.z);
    const std::vector<VertexLoop> holes(domain.loops.begin() + static_cast<std::ptrdiff_t>(domain.first_hole),
                                        domain.loops.end());
    const double extent = points.maxCoeff() - points.minCoeff();
    FlatSurface flat{domain.vertices, domain.surface.triangles, holes, points, round, lifts, &periods};
    flat.refuses = [&](const FoldoverPlaces& places) {
        return !are_apart(domain.first_hole, places.tracks, places.periods);
    };
    if (!options.importance.empty()) {
        VectorXd importance(domain.vertices.rows());
        for (Eigen::Index v = 0; v < importance.size(); ++v) importance[v] = options.importance[domain.original[v]];
        flat.sizes = size_factors(domain.vertices, domain.surface.triangles, importance);
    }
    // Relaxes; circles that meet are refused in each step, and looked at once more at the end.
    if (!make_even(flat, options.even, extent, context).moved) return false;
    std::vector<Track> tracks;
    for (const RoundLoop& loop : round) tracks.push_back(loop.track);
    if (!are_apart(domain.first_hole, tracks, periods)) return false;
    // Back in the units of the map, with the lower rim of a ring at v = 0.
    map.z = (points.col(0) + Complex(0.0, 1.0) * points.col(1)) / scale;
    for (std::size_t j = 0; j < periods.size(); ++j) map.periods[j] = periods[j] / scale;
    const Complex lower = domain.first_hole > 0 ? Complex(0.0, round.front().track.point.imag() / scale) : 0.0;
    map.z.array() -= lower;
    map.circles.clear();
    map.off_circle.clear();
    map.apart = true;
    // Vertices that did not stay on their line or circle.
    for (std::size_t k = 0; k < domain.first_hole; ++k)
        for (const Index v : domain.loops[k])
            if (std::abs(points(v, 1) - round[k].track.point.imag()) > uv_resolution * scale)
                map.off_circle.push_back(v);
    for (std::size_t k = domain.first_hole; k < round.size(); ++k) {
        const Circle circle{round[k].track.circle.center / scale - lower, round[k].track.circle.radius / scale};
        map.circles.push_back(circle);
        for (const Index v : domain.loops[k])
            if (!is_on_circle(circle, map.z[v], inner_circle_tolerance)) map.off_circle.push_back(v);
    }
    std::ranges::sort(map.off_circle);
    return true;
}

/// (3F, 2) by the corners of the domain's faces.
PlanarPoints tile_uv(const Tile& tile)
{
    PlanarPoints uv(static_cast<Eigen::Index>(tile.corners.size()), 2);
    for (Eigen::Index c = 0; c < uv.rows(); ++c)
        for (int i = 0; i < 2; ++i) uv(c, i) = uv_grid * static_cast<double>(tile.corners[c][i]);
    return uv;
}

/// The domain's faces by the input's vertices.
Triangles named_triangles(const PeriodicSurface& domain)
{
    return domain.surface.triangles.unaryExpr([&](Index v) { return domain.original[v]; });
}

/// (3F, 2) by the corners of the input's faces.
PlanarPoints corner_uvs(const Triangles& triangles, const PeriodicSurface& domain, const Tile& tile)
{
    return in_corner_order(tile_uv(tile), named_triangles(domain), triangles);
}

/// Measures the tile with corners of its own for every face. @param uv (3F, 2) of the input's corners
ComputedDistortion distortion_of(const Triangles& triangles, const PeriodicSurface& domain, const PlanarPoints& uv)
{
    const PlanarPoints own = in_corner_order(uv, triangles, named_triangles(domain));
    return measure_corner_distortion(domain.vertices, domain.surface.triangles, 2.0 * own.array() - 1.0);
}

TileLoop loop_report(const PeriodicSurface& domain, const FlatMap& map, std::size_t k)
{
    TileLoop loop;
    loop.rim = k < domain.first_hole;
    loop.vertices = domain.named_loop(k);
    loop.off_circle = domain.named_on_loop(k, map.off_circle);
    return loop;
}

/// The place in the tile of a point of the map, by the copy at a corner.
Complex in_tile(const FlatMap& map, const Tile& tile, Complex z, Eigen::Index corner)
{
    for (std::size_t j = 0; j < map.periods.size(); ++j)
        z += static_cast<double>(tile.lift[corner][j]) * map.periods[j];
    return tile.scale * z + tile.origin;
}

/// A corner of the loop's first vertex.
Eigen::Index corner_at(const PeriodicSurface& domain, std::size_t k)
{
    const Triangles& triangles = domain.surface.triangles;
    return std::find(triangles.data(), triangles.data() + triangles.size(), domain.loops[k].front()) - triangles.data();
}

/// Computes the ends of a slit: its two points that are farthest from each other.
void take_slit(const PeriodicSurface& domain, const FlatMap& map, const Tile& tile, std::size_t k, TileLoop& loop)
{
    const auto sum = [&](Index v) { return map.z[v].real() + map.z[v].imag(); };
    const auto [first, last] = std::ranges::minmax_element(domain.loops[k], {}, sum);
    const Eigen::Index corner = corner_at(domain, k);
    const Complex a = in_tile(map, tile, map.z[*first], corner), b = in_tile(map, tile, map.z[*last], corner);
    loop.is_slit = true;
    loop.slit = {{{a.real(), a.imag()}, {b.real(), b.imag()}}};
}

double cut_length(const PeriodicSurface& domain, const Tile& tile)
{
    double length = 0.0, area = 0.0;
    const Triangles& triangles = domain.surface.triangles;
    for (const Index h : tile.seams)
        length += 0.5 * (domain.vertices.row(target(triangles, h)) - domain.vertices.row(origin(triangles, h))).norm();
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const Eigen::RowVector3d a = domain.vertices.row(triangles(f, 1)) - domain.vertices.row(triangles(f, 0));
        const Eigen::RowVector3d b = domain.vertices.row(triangles(f, 2)) - domain.vertices.row(triangles(f, 0));
        area += 0.5 * Eigen::Vector3d(a.transpose()).cross(Eigen::Vector3d(b.transpose())).norm();
    }
    return area > 0.0 ? length / std::sqrt(area) : 0.0;
}

void warn(const PeriodicSurface& domain, const FlatMap& map, const TileFaults& faults, TileResult& result)
{
    warn_reoriented(domain.surface.reoriented, result.warnings);
    warn_inside_out(domain.vertices, domain.surface, result.warnings);
    // Of the iteration.
    if (!map.converged)
        result.warnings.push_back({WarningKind::not_converged, "the iteration ended before it reached its tolerance"});
    if (!map.apart)
        result.warnings.push_back(
            {WarningKind::no_circles, "the circles of two holes meet: the mesh is too coarse between them"});
    warn_off_circle(values_at(domain.original, map.off_circle), result.warnings);
    // Of the tile as stored.
    if (!faults.below_resolution.empty())
        result.warnings.push_back({WarningKind::below_resolution,
                                   counted(faults.below_resolution.size(), "face") + " too small for 32-bit UVs",
                                   faults.below_resolution});
    if (!faults.any()) return;
    if (!faults.holes.empty())
        result.warnings.push_back(
            {WarningKind::lost_circles,
             counted(faults.holes.size(), "loop") + " out of shape: they cross, or run the wrong way",
             {faults.holes.begin(), faults.holes.end()}});
    warn_not_one_to_one(faults.flipped, faults.below_resolution,
                        {faults.holes.empty() ? "" : counted(faults.holes.size(), "loop") + " out of shape",
                         faults.seams ? "the sides of the cut do not fit" : "",
                         faults.covering ? "the tile does not cover its cell exactly once" : ""},
                        result.warnings);
}

void name_tile(const CanonicalMesh& mesh, TileResult& result)
{
    for (TileLoop& loop : result.loops) {
        mesh.name_loop(loop.vertices);
        mesh.name_vertices(loop.off_circle);
    }
}

/// A tile after flips were turned back, with its faults.
struct CheckedTile {
    CheckedTile(const PeriodicSurface& domain, HoleShape holes, FlatMap& map, ExecutionContext& context)
    {
        turn_faces_back(domain, holes, map, context);
        tile = tile_of(domain, map);
        faults = find_faults(domain, tile, holes);
    }
    Tile tile;
    TileFaults faults;
};

TileResult reported(const Vertices& vertices, const Triangles& triangles, const PeriodicSurface& domain, double even,
                    HoleShape holes, const FlatMap& map, const CheckedTile& checked)
{
    const auto& [tile, faults] = checked;
    TileResult result;
    result.even = even;
    result.vertex_count = static_cast<Index>(vertices.rows());
    result.face_count = static_cast<Index>(triangles.rows());
    result.uv = corner_uvs(triangles, domain, tile);
    for (const GridPoint& period : tile.periods)
        result.periods.push_back({uv_grid * static_cast<double>(period[0]), uv_grid * static_cast<double>(period[1])});
    for (std::size_t k = 0; k < domain.loops.size(); ++k) {
        TileLoop& loop = result.loops.emplace_back(loop_report(domain, map, k));
        if (k < map.roundness.size()) loop.roundness = map.roundness[k];
        if (holes != HoleShape::open && !loop.rim) take_slit(domain, map, tile, k, loop);
    }
    // Measures of the map, and the verdict on the UVs as stored.
    result.turned = domain.surface.reoriented;
    result.cut_length = cut_length(domain, tile);
    result.converged = map.converged && map.apart && !faults.any();
    result.sweeps = static_cast<int>(map.changes.size());
    result.changes = map.changes;
    const SurfacePolygons polygons{vertices, triangles, domain.polygon, result.turned, {}, true};
    result.distortion = {distortion_of(triangles, domain, result.uv),
                         judge_corners(vertices, triangles, result.uv, result.turned)};
    warn(domain, map, faults, result);
    warn_concave_polygons(polygons, result.uv, result.warnings);
    if (domain.first_hole == 0 || even > 0.0)
        for (std::size_t k = 0; k < map.circles.size(); ++k) {
            TileLoop& loop = result.loops[domain.first_hole + k];
            loop.has_circle = map.apart;
            loop.circle = {in_tile(map, tile, map.circles[k].center, corner_at(domain, domain.first_hole + k)),
                           tile.scale * map.circles[k].radius};
        }
    return result;
}

/// Faces whose height is less than a part in ten million of their longest edge, or else the one with the least share.
std::vector<Index> thinnest_faces(const Vertices& vertices, const Triangles& triangles)
{
    constexpr double thin = 1e-7;  // dimensionless: shares below it are lost among the roundings of a factorization
    std::vector<Index> faces;
    Index thinnest = 0;
    double least = INFINITY;
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f) {
        const Eigen::RowVector3d a = vertices.row(triangles(f, 1)) - vertices.row(triangles(f, 0));
        const Eigen::RowVector3d b = vertices.row(triangles(f, 2)) - vertices.row(triangles(f, 0));
        const double longest = std::max({a.norm(), b.norm(), (b - a).norm()});
        const double share = longest > 0.0 ? (a / longest).cross(b / longest).norm() : 0.0;
        if (share < thin) faces.push_back(f);
        if (!(share < least)) continue;
        least = share;
        thinnest = f;
    }
    if (faces.empty()) faces.push_back(thinnest);
    return faces;
}

}  // namespace

TileResult canonical_tile(const Vertices& vertices, const Triangles& triangles, const TileOptions& options,
                          ExecutionContext& context, TileMap* map)
{
    require_weights("an importance", options.importance, static_cast<Index>(vertices.rows()));
    require_use_of_importance(options.importance, options.even);
    const auto compute = [map](const CanonicalMesh& mesh, TileOptions& here, ExecutionContext& own) {
        require_even(here.even);
        here.outer = mesh.vertex(here.outer);
        here.inner = mesh.vertex(here.inner);
        here.importance = mesh.of_vertices(here.importance);
        return map(mesh.vertices, mesh.triangles, here, own);
    };
    try {
        return corner_map<TileResult>(vertices, triangles, options, context, compute, name_tile);
    } catch (const OutOfMemory&) {
        throw;
    } catch (const SolverError& error) {
        if (!error.elements().empty()) throw;
        std::vector<Index> faces = thinnest_faces(vertices, triangles);
        throw SolverError("the map's equations have no solution: " + counted(faces.size(), "face") +
                              (faces.size() == 1 ? " is" : " are") + " too thin (" + error.what() + ")",
                          ElementKind::faces, std::move(faces));
    }
}

TileResult tile_result(const Vertices& vertices, const Triangles& triangles, const PeriodicSurface& domain,
                       const TileOptions& options, HoleShape holes, FlatMap& map, ExecutionContext& context)
{
    if (options.even > 0.0) {
        FlatMap even = map;
        if (make_tile_even(domain, options, even, context)) {
            const CheckedTile checked(domain, holes, even, context);
            if (!checked.faults.any()) {
                map = std::move(even);
                return reported(vertices, triangles, domain, options.even, holes, map, checked);
            }
        }
    }
    const CheckedTile checked(domain, holes, map, context);
    TileResult result = reported(vertices, triangles, domain, 0.0, holes, map, checked);
    if (options.even > 0.0) warn_not_even({}, result.warnings);
    return result;
}

}  // namespace koebe
