#include "flat/flat_part.h"

#include "circles/circle_fit.h"
#include "core/complex_places.h"
#include "core/connectivity.h"
#include "core/errors.h"
#include "core/numbering.h"
#include "cost/tolerances.h"
#include "cost/tuning.h"
#include "flat/flat_repair.h"
#include "flat/free_rims.h"
#include "flat/tube_slit.h"
#include "planar/boundary_crossings.h"
#include "planar/planar_predicates.h"
#include "quality/distortion.h"
#include "quality/stored_uv.h"
#include "surface/harmonic_map.h"
#include "surface/intrinsic_metric.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace koebe {
namespace {

constexpr double most_image = 4.0;  // UV area of a part over its area: even texels never need more

std::vector<VertexLoop> original_loops(const PartMesh& mesh)
{
    std::vector<VertexLoop> loops;
    for (const VertexLoop& loop : mesh.surface.loops) loops.push_back(values_at(mesh.original, loop));
    return loops;
}

double longest_edge(const PlanarPoints& p, const Triangles& triangles, Eigen::Index f)
{
    double longest = 0.0;
    for (int k = 0; k < 3; ++k)
        longest = std::max(longest, (p.row(triangles(f, k)) - p.row(triangles(f, (k + 1) % 3))).norm());
    return longest;
}

/// Scales a part so that the mean of u is 0, with u cut off at the ends of the window of least overflow. So parts
/// within their windows get one texel density. Faces as small as rounding do not count. A part whose even faces are
/// only a small piece of its image is not enlarged for them: the other parts would lose too much room.
void scale_evenly(const PartMesh& mesh, FlatPart& flat)
{
    const Eigen::Index count = flat.surface.triangles.rows();
    const double floor = tolerance::rounded_edge * box_size(flat.points).maxCoeff();
    const auto [u, lost, image] = flat_density(flat, mesh.areas, floor);
    const Evenness even = evenness(u, mesh.areas, lost);
    double sum = 0.0, known = 0.0;
    for (Eigen::Index f = 0; f < count; ++f) {
        if (lost[f]) continue;
        sum += mesh.areas[f] * std::clamp(u[f], even.from, even.from + tuning::even_range);
        known += mesh.areas[f];
    }
    if (known > 0.0) flat.points *= std::min(std::exp(-sum / known), std::sqrt(most_image * mesh.area / image));
}

/// Faces turned over.
Index flaws(const Surface& surface, const PlanarPoints& points)
{
    Index count = 0;
    for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f)
        count += !(signed_area(points, surface.triangles, f) > 0.0);
    return count;
}

/// Makes the inside of a disk again with the boundary held: moving only the vertices by a Moebius map bends faces.
PlanarPoints harmonic_again(const PartMesh& mesh, const VectorXcd& positions)
{
    const Surface& surface = mesh.surface;
    const IntrinsicMetric metric = intrinsic_metric(mesh.vertices, surface);
    std::vector<Index> boundary;
    for (const VertexLoop& loop : surface.loops) boundary.insert(boundary.end(), loop.begin(), loop.end());
    const VectorXcd values = positions(boundary);
    try {
        return planar_points(harmonic_map(metric.triangles, metric.lengths, surface.vertex_count, boundary, values));
    } catch (const SolverError&) {
        return PlanarPoints::Constant(surface.vertex_count, 2, std::numeric_limits<double>::quiet_NaN());
    }
}

/// The map's places, or harmonic places: whichever has fewer faces turned over, then less angle error.
class DiskPoints {
public:
    explicit DiskPoints(const PartMesh& mesh) : mesh_(mesh) {}
    void consider(const VectorXcd& positions)
    {
        take(planar_points(positions));
        take(harmonic_again(mesh_, positions));
    }
    const PlanarPoints& best() const { return best_; }

private:
    void take(const PlanarPoints& points)
    {
        if (!points.allFinite()) return;
        const Index turned = flaws(mesh_.surface, points);
        const double error = measure_distortion(mesh_.vertices, mesh_.surface.triangles, points).angle_error_deg.mean;
        if (best_.rows() > 0 && std::pair(turned, error) >= std::pair(turned_, error_)) return;
        best_ = points;
        turned_ = turned;
        error_ = error;
    }

    const PartMesh& mesh_;
    PlanarPoints best_;
    Index turned_ = 0;
    double error_ = 0.0;
};

/// Finds the rims of the part's loops, improves its angles, and frees rims at cuts from their circles and lines.
/// @param own for each vertex of the flat part the vertex of the part
void settle(const PartMesh& mesh, const std::vector<Index>& own, const FlatOptions& options, FlatPart& flat,
            ExecutionContext& context)
{
    std::vector<int> loop_of(mesh.original.size(), -1);
    for (std::size_t k = 0; k < mesh.surface.loops.size(); ++k)
        for (const Index v : mesh.surface.loops[k]) loop_of[v] = static_cast<int>(k);
    flat.rims.assign(mesh.surface.loops.size(), {});
    RimFreedom freedom{std::vector<Index>(own.size()), std::vector<char>(own.size(), 0)};
    std::vector<Index> first(mesh.original.size(), -1);
    for (std::size_t i = 0; i < own.size(); ++i) {
        const Index v = own[i];
        if (first[v] < 0) first[v] = static_cast<Index>(i);
        freedom.same[i] = first[v];
        if (loop_of[v] < 0) continue;
        flat.rims[loop_of[v]].push_back(static_cast<Index>(i));
        freedom.held[i] = options.round_cuts || mesh.border[v];
    }
    free_rims(flat.vertices, flat.surface, freedom, flat.points, context);
    flat.held = std::move(freedom.held);
}

/// The flat part without a slit, and without points yet.
FlatPart unopened(const PartMesh& mesh)
{
    FlatPart flat;
    flat.faces = mesh.faces;
    flat.original = mesh.original;
    flat.vertices = mesh.vertices;
    flat.surface = mesh.surface;
    flat.polygon = mesh.polygon;
    return flat;
}

FlatPart as_disk(const Part& part, const FlatOptions& options, ExecutionContext& context)
{
    FlatPart flat = unopened(part.mesh);
    DiskPoints points(part.mesh);
    points.consider(part.map.positions);
    flat.points = points.best();
    if (flat.points.rows() == 0) flat.points = embedded_anew(part.mesh.vertices, part.mesh.surface, context);
    if (!flat.points.allFinite()) throw SolverError("the map of a part is not finite");
    std::vector<Index> own = numbers_below(flat.original.size());
    settle(part.mesh, own, options, flat, context);
    return flat;
}

/// The flat part opened along its slit. @return without points if it cannot be opened
FlatPart as_tube(const Part& part, const FlatOptions& options, ExecutionContext& context)
{
    FlatPart flat;
    flat.faces = part.mesh.faces;
    flat.polygon = part.mesh.polygon;
    flat.kind = PartKind::tube;
    const TubeSlit slit = tube_slit(part);
    if (slit.lift.empty()) return flat;
    flat.slit = slit.length;
    const Triangles& triangles = part.mesh.surface.triangles;
    // A vertex for each side of the slit: its number of turns round the tube tells them apart.
    std::map<std::pair<Index, int>, Index> number;
    std::vector<Index> own;
    Triangles opened(triangles.rows(), 3);
    for (Index c = 0; c < static_cast<Index>(triangles.size()); ++c) {
        const Index v = triangles.data()[c];
        const auto [at, is_new] = number.try_emplace({v, slit.lift[c]}, static_cast<Index>(own.size()));
        if (is_new) own.push_back(v);
        opened.data()[c] = at->second;
    }
    // The strip log z, each turn higher by 2 pi.
    constexpr double two_pi = 2.0 * EIGEN_PI;
    flat.points.resize(static_cast<Eigen::Index>(own.size()), 2);
    for (const auto& [key, k] : number)
        flat.points.row(k) << part.map.strip[key.first].real(), part.map.strip[key.first].imag() + two_pi * key.second;
    flat.vertices = part.mesh.vertices(own, Eigen::all);
    flat.original = values_at(part.mesh.original, own);
    try {
        flat.surface = require_bordered_genus_zero(opened, static_cast<Index>(own.size()));
        if (flat.surface.loops.size() == 1)
            settle(part.mesh, own, options, flat, context);
        else
            flat.points.resize(0, 2);
    } catch (const TopologyError&) {  // the slit pinches the opened tube
        flat.points.resize(0, 2);
    }
    return flat;
}

}  // namespace

void take_vertices(const FlatPart& part, const std::vector<Index>& vertices, FlatPart& piece)
{
    piece.original = values_at(part.original, vertices);
    piece.image = values_at(part.image, vertices);
    piece.held = values_at(part.held, vertices);
    piece.shown = values_at(part.shown, vertices);
    piece.vertices = part.vertices(vertices, Eigen::all);
    piece.points = part.points(vertices, Eigen::all);
}

void note_shown(const std::vector<double>& shown, std::vector<FlatPart>& parts)
{
    for (FlatPart& part : parts) part.shown = values_at(shown, part.original);
}

double summed_angle_error(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& points)
{
    return measure_distortion(vertices, triangles, points).angle_error_deg.mean * static_cast<double>(triangles.rows());
}

double sum_of_angle_errors(const FlatPart& part)
{
    return summed_angle_error(part.vertices, part.surface.triangles, part.points);
}

double sum_of_upright_angle_errors(const FlatPart& part)
{
    std::vector<Index> upright;
    for (Index f = 0; f < static_cast<Index>(part.faces.size()); ++f)
        if (signed_area(part.points, part.surface.triangles, f) > 0.0) upright.push_back(f);
    if (upright.empty()) return 0.0;
    return summed_angle_error(part.vertices, part.surface.triangles(upright, Eigen::all), part.points);
}

double angle_error(const std::vector<FlatPart>& parts)
{
    double sum = 0.0, faces = 0.0;
    for (const FlatPart& part : parts) {
        sum += sum_of_angle_errors(part);
        faces += static_cast<double>(part.faces.size());
    }
    return sum / faces;
}

FlatDensity flat_density(const FlatPart& flat, const VectorXd& areas, double floor)
{
    FlatDensity density{VectorXd::Zero(areas.size()), std::vector<char>(static_cast<std::size_t>(areas.size()), 0)};
    for (Eigen::Index f = 0; f < areas.size(); ++f) {
        const double area = signed_area(flat.points, flat.surface.triangles, f);
        density.image += std::max(area, 0.0);
        density.lost[f] =
            !(area > 0.0) || !(areas[f] > 0.0) || !(longest_edge(flat.points, flat.surface.triangles, f) > floor);
        if (!density.lost[f]) density.u[f] = 0.5 * std::log(area / areas[f]);
    }
    return density;
}

FlatPart whole_part(const CutSurface& whole)
{
    FlatPart flat;
    flat.faces = numbers_below(whole.areas.size());
    flat.original = numbers_below(whole.vertices.rows());
    flat.vertices = whole.vertices;
    flat.surface = whole.surface;
    flat.points = PlanarPoints::Zero(whole.vertices.rows(), 2);
    flat.held.assign(flat.original.size(), 0);
    flat.polygon = whole.polygon;
    flat.shown = whole.shown;
    return flat;
}

FlatPart flat_part(const Part& part, const FlatOptions& options, ExecutionContext& context)
{
    FlatPart flat;
    if (part.map.kind == PartKind::tube && part.map.strip.size() > 0) flat = as_tube(part, options, context);
    const bool pays = part.map.tube_overflow + options.prices.of(0.0, flat.slit) <= part.map.disk_overflow;
    if (flat.points.rows() == 0 || !pays) {
        flat = as_disk(part, options, context);
    } else if (const Index flips = flaws(flat.surface, flat.points); flips > 0) {
        FlatPart disk = as_disk(part, options, context);
        if (flaws(disk.surface, disk.points) < flips && part.map.circles[1 - part.map.outer].radius > 1e-3)
            flat = std::move(disk);
    }
    flat.loops = original_loops(part.mesh);
    scale_evenly(part.mesh, flat);
    return flat;
}

FlatPart flat_as_mapped(const PartMesh& mesh, const PlanarPoints& points)
{
    FlatPart flat = unopened(mesh);
    flat.points = points;
    flat.rims.assign(mesh.surface.loops.begin(), mesh.surface.loops.end());
    flat.loops = original_loops(mesh);
    flat.held = mesh.border;
    scale_evenly(mesh, flat);
    return flat;
}

std::vector<double> off_round(const FlatPart& part, const PlanarPoints& uv)
{
    std::vector<double> off;
    for (const std::vector<Index>& rim : part.rims) {
        const PlanarPoints at = uv(rim, Eigen::all);
        if (part.kind == PartKind::tube) {
            const Eigen::RowVector2d extent = box_size(at);
            off.push_back(std::numbers::pi * extent.minCoeff() / std::max(extent.maxCoeff(), 1e-300));
            continue;
        }
        const VectorXcd points = at.col(0) + Complex(0.0, 1.0) * at.col(1);
        const Circle circle = fit_circle_least_squares(points);
        off.push_back(((points.array() - circle.center).abs() - circle.radius).abs().maxCoeff() /
                      std::max(circle.radius, 1e-300));
    }
    return off;
}

bool loops_apart(const FlatPart& part, const PlanarPoints& uv)
{
    const PlanarPoints stored = uv.unaryExpr(&as_stored);
    return !loops_cross(part.surface.loops, stored, tolerance::drawn_edge) &&
           turned_loops(part.surface.loops, stored, tolerance::drawn_edge).empty();
}

bool lies_one_to_one(const FlatPart& part, const PlanarPoints& points)
{
    if (!points.allFinite()) return false;
    for (Eigen::Index f = 0; f < part.surface.triangles.rows(); ++f)
        if (!(signed_area(points, part.surface.triangles, f) > 0.0)) return false;
    return !loops_cross(part.surface.loops, points, 0.0) && turned_loops(part.surface.loops, points, 0.0).empty();
}

}  // namespace koebe
