#include "parts/pack_parts.h"

#include "core/errors.h"
#include "execution/side_by_side.h"
#include "parts/packing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>

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

IslandPacking shrunk(IslandPacking packing, double factor)
{
    for (IslandPlace& place : packing.places) place.offset *= factor;
    packing.scale *= factor;
    packing.margin *= factor;
    return packing;
}

/// The largest number of six digits that is not above this one.
double rounded_down(double number)
{
    const double step = std::pow(10.0, std::floor(std::log10(number)) - 5.0);
    return std::floor(number / step) * step;
}

std::string in_digits(double number)
{
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.6g", number);
    return text.data();
}

[[noreturn]] void throw_too_dense(const WantedScale& wanted, double largest)
{
    throw InputError("a density of " + in_digits(wanted.density) +
                     " pixels per unit does not fit into the square: at most " +
                     in_digits(rounded_down(wanted.density * largest / wanted.scale)) + " does");
}

/// At the wanted scale the margin between parts stays, if they leave room for it.
IslandPacking pack_outlines(const std::vector<Outline>& outlines, const std::optional<WantedScale>& wanted)
{
    const double room = margin + 2.0 * rim_slack;
    IslandPacking largest = pack_islands(outlines, room);
    if (!wanted) return largest;
    const double factor = wanted->scale / largest.scale;
    if (factor > 1.0) throw_too_dense(*wanted, largest.scale);
    if (const IslandPacking wider = pack_islands(outlines, room / factor); wider.scale >= wanted->scale)
        return shrunk(wider, wanted->scale / wider.scale);
    return shrunk(std::move(largest), factor);
}

}  // namespace

PackedParts pack_parts(std::vector<FlatPart>& flats, int threads, ExecutionContext& context,
                       const std::optional<WantedScale>& wanted)
{
    PackedParts packed{std::vector<PlanarPoints>(flats.size()), std::vector<char>(flats.size(), 0)};
    std::vector<PlanarPoints>& places = packed.places;
    bool again = true;
    for (int round = 1; again; ++round) {
        std::vector<Outline> outlines;
        for (const FlatPart& flat : flats) outlines.push_back(outline_of(flat));
        const IslandPacking packing = pack_outlines(outlines, wanted);
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
