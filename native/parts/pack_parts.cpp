#include "parts/pack_parts.h"

#include "core/errors.h"
#include "execution/side_by_side.h"
#include "parts/packing.h"

#include <algorithm>
#include <cstddef>

namespace koebe {
namespace {

constexpr double margin = 8.0 / 2048;  // between parts, in the unit square
constexpr double rim_slack = 5e-5;     // a repair may move a rim there by this,
constexpr int packing_rounds = 4;      // before the part is packed again

/// The part's loops, and its faces that are turned over: a fold may lie outside the loops. A tube's straight ends stay
/// along the axes.
Outline outline_of(const FlatPart& flat)
{
    Outline outline{flat.points, flat.surface.loops, flat.kind == PartKind::tube};
    for (const auto& face : flat.surface.triangles.rowwise()) {
        const Eigen::RowVector2d a = flat.points.row(face[1]) - flat.points.row(face[0]);
        const Eigen::RowVector2d b = flat.points.row(face[2]) - flat.points.row(face[0]);
        if (a[0] * b[1] < a[1] * b[0]) outline.loops.push_back({face[0], face[2], face[1]});
    }
    return outline;
}

/// The largest way of a boundary vertex.
double rim_moved(const FlatPart& flat, const PlanarPoints& from, const PlanarPoints& to)
{
    double most = 0.0;
    for (const VertexLoop& loop : flat.surface.loops)
        for (const Index v : loop) most = std::max(most, (to.row(v) - from.row(v)).norm());
    return most;
}

}  // namespace

PackedParts pack_parts(std::vector<FlatPart>& flats, int threads, ExecutionContext& context)
{
    PackedParts packed{std::vector<PlanarPoints>(flats.size()), std::vector<char>(flats.size(), 0)};
    std::vector<PlanarPoints>& places = packed.places;
    bool again = true;
    for (int round = 1; again; ++round) {
        std::vector<Outline> outlines;
        for (const FlatPart& flat : flats) outlines.push_back(outline_of(flat));
        const IslandPacking packing = pack_islands(outlines, margin + 2.0 * rim_slack);
        std::vector<char> outgrown(flats.size(), 0);
        side_by_side(flats.size(), threads, context, [&](std::size_t k, ExecutionContext& own) {
            const PlanarPoints before = place_island(flats[k].points, packing.places[k], packing.scale);
            const PartKind kind = flats[k].kind;
            places[k] = before;
            repair_flips(flats[k], places[k], own);
            const PlanarPoints repaired = places[k];
            embed_safely(flats[k], places[k], own);
            const bool anew = places[k] != repaired;
            if (!places[k].allFinite()) throw SolverError("the map of a part is not finite");
            const bool fits = !(rim_moved(flats[k], before, places[k]) > rim_slack);
            if (!fits && round == packing_rounds) {
                places[k] = before;
                flats[k].kind = kind;
                return;
            }
            if (anew) packed.anew[k] = 1;
            if (fits) return;
            flats[k].points = places[k] / packing.scale;
            outgrown[k] = 1;
        });
        again = std::ranges::count(outgrown, 1) > 0;
    }
    side_by_side(flats.size(), threads, context, [&](std::size_t k, ExecutionContext&) {
        places[k] = places[k].cwiseMax(0.0).cwiseMin(1.0);
        if (!loops_apart(flats[k], places[k])) flats[k].one_to_one = false;
    });
    return packed;
}

}  // namespace koebe
