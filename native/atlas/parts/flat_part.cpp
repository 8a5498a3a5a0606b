#include "parts/flat_part.h"

#include "circles/circle_fit.h"
#include "core/complex_places.h"
#include "core/connectivity.h"
#include "core/errors.h"
#include "cost/tolerances.h"
#include "cost/tuning.h"
#include "embedding/embedded_map.h"
#include "foldover/untangle.h"
#include "parts/free_rims.h"
#include "parts/regions.h"
#include "parts/tube_slit.h"
#include "planar/boundary_crossings.h"
#include "planar/planar_predicates.h"
#include "quality/distortion.h"
#include "quality/stored_uv.h"
#include "surface/harmonic_map.h"
#include "surface/intrinsic_metric.h"
#include "surface/loop_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

namespace koebe {
namespace {

constexpr double box_slack = 1e-3;  // UV units: how far a repair may leave the part's box, a quarter of the least gap
constexpr double rounded_height = 2.5e-7;  // UV units: a face with that height is upright as stored
constexpr int most_nudges = 200;           // rounds in which a face gets it
constexpr double drawn_out = 0.1;          // of the noise: gap between edges that it made cross
constexpr double most_image = 4.0;         // UV area of a part over its area: even texels never need more

std::vector<VertexLoop> original_loops(const PartMesh& mesh)
{
    std::vector<VertexLoop> loops;
    for (const VertexLoop& loop : mesh.surface.loops) {
        VertexLoop own;
        for (const Index v : loop) own.push_back(mesh.original[v]);
        loops.push_back(std::move(own));
    }
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

/// Faces that are not upright, seen from some corner, as they are stored. @param uv in [0, 1]^2
Index stored_flips(const Surface& surface, const PlanarPoints& uv)
{
    const PlanarPoints points = 2.0 * uv.array() - 1.0;
    Index count = 0;
    for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f)
        count += StoredFace(surface.triangles, points, f).doubtful();
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

template <typename Value>
void take(const std::vector<Value>& from, const std::vector<Index>& which, std::vector<Value>& to)
{
    if (from.empty()) return;
    for (const Index i : which) to.push_back(from[i]);
}

/// A map that is one to one, for any part. The longest loop is the outer loop.
PlanarPoints embedded_anew(const Vertices& vertices, const Surface& surface, const ExecutionContext& context)
{
    std::vector<VertexLoop> loops = surface.loops;
    std::ranges::stable_sort(loops, std::ranges::greater(),
                             [&](const VertexLoop& loop) { return loop_edges(vertices, loop).sum(); });
    return freely_embedded(vertices, surface, loops, context);
}

FlatPart as_disk(const Part& part, const FlatOptions& options, ExecutionContext& context)
{
    FlatPart flat = unopened(part.mesh);
    DiskPoints points(part.mesh);
    points.consider(part.map.positions);
    flat.points = points.best();
    if (flat.points.rows() == 0) flat.points = embedded_anew(part.mesh.vertices, part.mesh.surface, context);
    if (!flat.points.allFinite()) throw SolverError("the map of a part is not finite");
    std::vector<Index> own(flat.original.size());
    std::iota(own.begin(), own.end(), 0);
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
    for (const Index v : own) flat.original.push_back(part.mesh.original[v]);
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

void take_faces(const FlatPart& part, const std::vector<Index>& faces, FlatPart& piece)
{
    take(part.faces, faces, piece.faces);
    take(part.polygon, faces, piece.polygon);
    take(part.sizes, faces, piece.sizes);
}

void take_vertices(const FlatPart& part, const std::vector<Index>& vertices, FlatPart& piece)
{
    take(part.original, vertices, piece.original);
    take(part.image, vertices, piece.image);
    take(part.held, vertices, piece.held);
    take(part.shown, vertices, piece.shown);
    piece.vertices = part.vertices(vertices, Eigen::all);
    piece.points = part.points(vertices, Eigen::all);
}

void note_shown(const std::vector<double>& shown, std::vector<FlatPart>& parts)
{
    for (FlatPart& part : parts) {
        part.shown.clear();
        if (!shown.empty())
            for (const Index v : part.original) part.shown.push_back(shown[v]);
    }
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

namespace {

/// Moves the corner opposite to the longest edge of a face, so that the face is that high.
/// @return false, and nothing moves, if the face is higher, or so low that it is no sliver
bool raise_sliver(const Triangles& triangles, Eigen::Index f, double height, double lowest, PlanarPoints& points)
{
    const auto edge = [&](int k) -> Eigen::RowVector2d {
        return points.row(triangles(f, (k + 2) % 3)) - points.row(triangles(f, (k + 1) % 3));
    };
    int corner = 0;
    for (int k = 1; k < 3; ++k)
        if (edge(k).squaredNorm() > edge(corner).squaredNorm()) corner = k;
    const Eigen::RowVector2d base = edge(corner);
    const double length = base.norm(), now = 2.0 * signed_area(points, triangles, f) / length;
    if (!(now < height && now > lowest)) return false;
    points.row(triangles(f, corner)) += (height - now) / length * Eigen::RowVector2d(-base[1], base[0]);
    return true;
}

/// Moves a corner of each face that only rounding turns over, such as a sliver where solids were cut, by that rounding.
/// So parts true to size stay so. @param uv in [0, 1]^2 or another tile
PlanarPoints without_rounded_flips(const FlatPart& part, PlanarPoints uv)
{
    const Triangles& triangles = part.surface.triangles;
    const double height = rounded_height * std::max(1.0, uv.maxCoeff());
    const auto stored = [&](Index v) { return StoredPoint{as_stored(uv(v, 0)), as_stored(uv(v, 1))}; };
    bool any = true;
    for (int round = 0; any && round < most_nudges; ++round) {
        any = false;
        for (Eigen::Index f = 0; f < triangles.rows(); ++f)
            if (StoredFace(stored(triangles(f, 0)), stored(triangles(f, 1)), stored(triangles(f, 2))).doubtful() &&
                raise_sliver(triangles, f, height, -height, uv))
                any = true;
    }
    return uv;
}

/// Moves an end of one of two boundary edges that cross out of the face at the other edge, by at most this much.
/// @param a, b the edges' ends @return false, and nothing moves, if it lies deeper
bool draw_out(const std::array<Index, 2>& a, const std::array<Index, 2>& b, double most, PlanarPoints& points)
{
    double least = most;
    Index moved = -1;
    Eigen::RowVector2d way;
    for (const auto& [edge, ends] : {std::pair(a, b), std::pair(b, a)}) {
        const Eigen::RowVector2d from = points.row(edge[0]), along = points.row(edge[1]) - from;
        const double length = along.norm();
        if (!(length > 0.0)) continue;
        const Eigen::RowVector2d inward(-along[1] / length, along[0] / length);
        for (const Index v : ends) {
            const Eigen::RowVector2d arm = points.row(v) - from;
            const double depth = arm.dot(inward), place = arm.dot(along) / (length * length);
            if (v == edge[0] || v == edge[1] || !(depth >= 0.0 && depth < least && place > 0.0 && place < 1.0))
                continue;
            least = depth;
            moved = v;
            way = -(depth + drawn_out / noise_reach * most) * inward;
        }
    }
    if (moved >= 0) points.row(moved) += way;
    return moved >= 0;
}

}  // namespace

void mend_noise(FlatPart& part, double noise)
{
    const PlanarPoints before = part.points;
    const double most = noise_reach * noise;
    PlanarPoints& points = part.points;
    std::vector<Index> next(static_cast<std::size_t>(part.surface.vertex_count), -1), previous(next);
    for (const VertexLoop& loop : part.surface.loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
            next[loop[i]] = loop[(i + 1) % loop.size()];
            previous[next[loop[i]]] = loop[i];
        }
    const auto inward = [&](Index a, Index b) -> Eigen::RowVector2d {
        return Eigen::RowVector2d(points(a, 1) - points(b, 1), points(b, 0) - points(a, 0)).stableNormalized();
    };
    // Corners of the boundary that lie nearly in one place are drawn into their faces.
    const auto draw_in = [&](Index a, Index b) {
        bool any = false;
        for (const Index v : {a, next[a]})
            for (const Index w : {b, next[b]})
                if (v != w && (points.row(v) - points.row(w)).norm() < most) {
                    for (const Index u : {v, w})
                        points.row(u) +=
                            drawn_out * noise * (inward(previous[u], u) + inward(u, next[u])).stableNormalized();
                    any = true;
                }
        return any;
    };
    bool any = true;
    for (int round = 0; any && round < most_nudges; ++round) {
        any = false;
        for (Eigen::Index f = 0; f < part.surface.triangles.rows(); ++f)
            if (!(signed_area(points, part.surface.triangles, f) > 0.0) &&
                raise_sliver(part.surface.triangles, f, 2.0 * rounded_height, -most, points))
                any = true;
        if (any) continue;
        for (const auto& [a, b] : crossing_boundary_edges(part.surface.loops, points, 0.0))
            if (draw_out({a, next[a]}, {b, next[b]}, most, points) || draw_in(a, b)) any = true;
    }
    // It must stay where it was, up to some times the noise.
    if (!lies_one_to_one(part, points) || (points - before).rowwise().norm().maxCoeff() > 2.0 * most) points = before;
}

Index repair_flips(const FlatPart& part, PlanarPoints& uv, const ExecutionContext& context)
{
    const auto bad = [&](const PlanarPoints& points) {
        return stored_flips(part.surface, 0.5 * (points.array() + 1.0));
    };
    PlanarPoints points = 2.0 * uv.array() - 1.0;
    const Eigen::RowVector2d low = uv.colwise().minCoeff().array() - box_slack;
    const Eigen::RowVector2d high = uv.colwise().maxCoeff().array() + box_slack;
    const Eigen::RowVector2d corner = (0.5 * (low + high)).array().floor();
    Index least = bad(points);
    // The middle vertex of a face with two edges on one loop may leave it at once: on the straight end of a tube that
    // face is flat.
    std::vector<Index> faces_at(part.surface.vertex_count, 0), boundary, held;
    for (Eigen::Index c = 0; c < part.surface.triangles.size(); ++c) ++faces_at[part.surface.triangles.data()[c]];
    for (const VertexLoop& loop : part.surface.loops) boundary.insert(boundary.end(), loop.begin(), loop.end());
    std::ranges::sort(boundary);
    std::ranges::copy_if(boundary, std::back_inserter(held), [&](Index v) { return faces_at[v] > 1; });
    const std::vector<Circle> circles(part.surface.loops.size());
    RepairEffort effort(part.surface.triangles.rows());
    const auto take = [&](const PlanarPoints& moved) {
        const PlanarPoints in_square =
            ((0.5 * (moved.array() + 1.0)).matrix().rowwise() - corner).cwiseMax(0.0).cwiseMin(1.0).rowwise() + corner;
        const bool in_box = (in_square.colwise().minCoeff().array() >= low.array()).all() &&
                            (in_square.colwise().maxCoeff().array() <= high.array()).all();
        if (!moved.allFinite() || !in_box || !loops_apart(part, in_square)) return;
        const PlanarPoints found = 2.0 * in_square.array() - 1.0;
        const Index count = bad(found);
        if (count >= least) return;
        least = count;
        points = found;
        uv = in_square;
    };
    if (const PlanarPoints nudged = 2.0 * without_rounded_flips(part, uv).array() - 1.0; least > 0 && bad(nudged) == 0)
        take(nudged);
    for (const auto& stay : {held, std::vector<Index>{}}) {
        if (least == 0) break;
        PlanarPoints moved = points;
        untangle(part.vertices, part.surface, part.surface.loops, circles, boundary, moved, context,
                 {.slide = false, .held = stay, .effort = &effort, .share = stay.empty() ? 1.0 : 0.5});
        take(moved);
    }
    return least;
}

void embed_safely(FlatPart& part, PlanarPoints& uv, ExecutionContext& context)
{
    const auto flaws_of = [&](const PlanarPoints& places) {
        return std::make_pair(stored_flips(part.surface, places), !loops_apart(part, places));
    };
    const auto before = flaws_of(uv);
    if (before.first == 0 && !before.second) return;
    PlanarPoints disk;
    try {
        disk = embedded_anew(part.vertices, part.surface, context);
    } catch (const SolverError&) {
        return;
    }
    const Eigen::RowVector2d low = uv.colwise().minCoeff(), high = uv.colwise().maxCoeff();
    PlanarPoints places = (0.5 * (high - low).minCoeff() * disk).rowwise() + 0.5 * (low + high);
    repair_flips(part, places, context);
    const auto after = flaws_of(places);
    if (!places.allFinite() || after >= before) return;
    uv = places;
    part.kind = PartKind::disk;
}

}  // namespace koebe
