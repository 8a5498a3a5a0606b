#include "parts/flat_repair.h"

#include "circles/circle.h"
#include "core/errors.h"
#include "embedding/embedded_map.h"
#include "foldover/untangle.h"
#include "planar/planar_predicates.h"
#include "quality/stored_uv.h"
#include "surface/loop_edges.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

namespace koebe {
namespace {

constexpr double box_slack = 1e-3;  // UV units: how far a repair may leave the part's box, a quarter of the least gap
constexpr double rounded_height = 2.5e-7;  // UV units: a face with that height is upright as stored
constexpr int most_nudges = 200;           // rounds in which a face gets it

/// Faces that are not upright, seen from some corner, as they are stored. @param uv in [0, 1]^2
Index stored_flips(const Surface& surface, const PlanarPoints& uv)
{
    const PlanarPoints points = 2.0 * uv.array() - 1.0;
    Index count = 0;
    for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f)
        count += StoredFace(surface.triangles, points, f).doubtful();
    return count;
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
        for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
            if (!StoredFace(stored(triangles(f, 0)), stored(triangles(f, 1)), stored(triangles(f, 2))).doubtful())
                continue;
            // The corner opposite to the longest edge gets that height over it.
            const auto edge = [&](int k) -> Eigen::RowVector2d {
                return uv.row(triangles(f, (k + 2) % 3)) - uv.row(triangles(f, (k + 1) % 3));
            };
            int corner = 0;
            for (int k = 1; k < 3; ++k)
                if (edge(k).squaredNorm() > edge(corner).squaredNorm()) corner = k;
            const Eigen::RowVector2d base = edge(corner);
            const double length = base.norm(), now = 2.0 * signed_area(uv, triangles, f) / length;
            if (!(std::abs(now) < height)) continue;
            uv.row(triangles(f, corner)) += (height - now) / length * Eigen::RowVector2d(-base[1], base[0]);
            any = true;
        }
    }
    return uv;
}

}  // namespace

/// A map that is one to one, for any part. The longest loop is the outer loop.
PlanarPoints embedded_anew(const Vertices& vertices, const Surface& surface, const ExecutionContext& context)
{
    std::vector<VertexLoop> loops = surface.loops;
    std::ranges::stable_sort(loops, std::ranges::greater(),
                             [&](const VertexLoop& loop) { return loop_edges(vertices, loop).sum(); });
    return freely_embedded(vertices, surface, loops, context);
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
