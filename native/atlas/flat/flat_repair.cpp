#include "flat/flat_repair.h"

#include "circles/circle.h"
#include "core/errors.h"
#include "embedding/embedded_map.h"
#include "flat/regions.h"
#include "foldover/untangle.h"
#include "planar/boundary_crossings.h"
#include "planar/planar_predicates.h"
#include "quality/stored_uv.h"
#include "surface/face_vectors.h"
#include "surface/loop_edges.h"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <utility>

namespace koebe {
namespace {

constexpr double box_slack = 1e-3;  // UV units: how far a repair may leave the part's box, a quarter of the least gap
constexpr double rounded_height = 2.5e-7;  // UV units: a face with that height is upright as stored
constexpr int most_nudges = 200;           // rounds in which a face gets it
constexpr double most_sunk = 16.0;         // of it: how deep raising faces may push another one
constexpr Eigen::Index large_part = 1000;  // faces: in a larger part
constexpr double most_mended = 0.01;       // more flips than this share are not turned back
constexpr double drawn_out = 0.1;          // of the noise: gap between edges that it made cross

/// Faces that are not upright, seen from some corner, as they are stored. @param uv in [0, 1]^2
Index stored_flips(const Surface& surface, const PlanarPoints& uv)
{
    const PlanarPoints points = 2.0 * uv.array() - 1.0;
    Index count = 0;
    for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f)
        count += StoredFace(surface.triangles, points, f).doubtful();
    return count;
}

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

/// Raises the faces that are turned over by at most this much, of those that may be raised. @return whether there are
/// any
template <typename MayRaise>
bool raise_turned(FlatPart& part, double most, const MayRaise& may_raise)
{
    const Triangles& triangles = part.surface.triangles;
    bool any = false;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        if (!(signed_area(part.points, triangles, f) > 0.0) && may_raise(f) &&
            raise_sliver(triangles, f, 2.0 * rounded_height, -most, part.points))
            any = true;
    return any;
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

PlanarPoints embedded_anew(const Vertices& vertices, const Surface& surface, const ExecutionContext& context)
{
    std::vector<VertexLoop> loops = surface.loops;
    std::ranges::stable_sort(loops, std::ranges::greater(),
                             [&](const VertexLoop& loop) { return loop_edges(vertices, loop).sum(); });
    return freely_embedded(vertices, surface, loops, context);
}

void raise_slivers(FlatPart& part)
{
    const Triangles& triangles = part.surface.triangles;
    const auto has_height = [&](Eigen::Index f) {
        double longest = 0.0;
        for (int k = 0; k < 3; ++k)
            longest = std::max(longest,
                               (part.points.row(triangles(f, k)) - part.points.row(triangles(f, (k + 1) % 3))).norm());
        return twice_area_vector(part.vertices, triangles, f).norm() > rounded_height * longest;
    };
    bool any = true;
    for (int round = 0; any && round < most_nudges; ++round)
        any = raise_turned(part, most_sunk * rounded_height, [&](Eigen::Index f) { return !has_height(f); });
}

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
        any = raise_turned(part, most, [](Eigen::Index) { return true; });
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
    const Eigen::Index count = part.surface.triangles.rows();
    if (count > large_part && static_cast<double>(least) > most_mended * static_cast<double>(count)) return least;
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
