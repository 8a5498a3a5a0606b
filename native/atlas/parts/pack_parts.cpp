#include "parts/pack_parts.h"

#include "core/errors.h"
#include "execution/side_by_side.h"
#include "flat/flat_repair.h"
#include "packing/tile_packing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>

namespace koebe {
namespace {

constexpr double rim_slack = 5e-5;  // UV units: a repair may move a rim by this,
constexpr int packing_rounds = 4;   // before the part is packed again

/// The part's loops, and its faces that are turned over: a fold may lie outside the loops. A tube's straight ends stay
/// along the axes.
/// @param is_stacked copies lie on each other
Outline outline_of(const FlatPart& flat, bool is_stacked)
{
    Outline outline{flat.points, flat.surface.loops, flat.along_axes, flat.has_copy && !is_stacked, flat.up};
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

[[noreturn]] void throw_too_dense(const WantedScale& wanted, double largest, int tiles)
{
    const std::string where = tiles == 1 ? "the square" : std::to_string(tiles) + " tiles";
    throw InputError("a density of " + in_digits(wanted.density) + " pixels per unit does not fit into " + where +
                     ": at most " + in_digits(rounded_down(wanted.density * largest / wanted.scale)) + " does");
}

/// At the wanted scale the margin between parts stays, if they leave room for it.
TilePacking pack_outlines(const std::vector<Outline>& outlines, const PackOptions& options)
{
    const double room = options.margin + 2.0 * rim_slack;
    if (!options.wanted) return pack_on_tiles(outlines, room, options.tiles);
    const WantedScale& wanted = *options.wanted;
    int tiles = options.tiles > 0 ? options.tiles : tiles_for(outlines, room, wanted.scale);
    TilePacking largest = pack_on_tiles(outlines, room, tiles);
    while (options.tiles == 0 && largest.scale < wanted.scale && tiles < most_tiles)
        largest = pack_on_tiles(outlines, room, ++tiles);
    const double factor = wanted.scale / largest.scale;
    if (factor > 1.0) throw_too_dense(wanted, largest.scale, tiles);
    if (const TilePacking wider = pack_on_tiles(outlines, room / factor, tiles); wider.scale >= wanted.scale)
        return shrunk(wider, wanted.scale / wider.scale);
    return shrunk(std::move(largest), factor);
}

/// Packs the parts without twins.
void pack_apart(std::vector<FlatPart>& flats, const PackOptions& options, PackedParts& packed,
                ExecutionContext& context)
{
    std::vector<std::size_t> alone;
    for (std::size_t k = 0; k < flats.size(); ++k)
        if (!packed.twins[k]) alone.push_back(k);
    std::vector<PlanarPoints>& places = packed.places;
    std::vector<int> tile;
    double margin = 0.0;
    bool again = true;
    for (int round = 1; again; ++round) {
        std::vector<Outline> outlines;
        for (const std::size_t k : alone) outlines.push_back(outline_of(flats[k], !options.twins.empty()));
        const TilePacking packing = pack_outlines(outlines, options);
        tile = packing.tile;
        margin = packing.margin;
        std::vector<char> outgrown(flats.size(), 0);
        // Repair each part where it lies. If its rim moves, all are packed again with the new outline; in the last
        // round it stays as it was.
        side_by_side(alone.size(), options.threads, context, [&](std::size_t i, ExecutionContext& own) {
            const std::size_t k = alone[i];
            const PlanarPoints before =
                place_island(flats[k].points, packing.places[i], packing.scale).rowwise() + tile_corner(tile[i]);
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
    // Rounding must not lead out of the tile.
    side_by_side(alone.size(), options.threads, context, [&](std::size_t i, ExecutionContext&) {
        const std::size_t k = alone[i];
        const Eigen::RowVector2d corner = tile_corner(tile[i]);
        places[k] = (places[k].rowwise() - corner).cwiseMax(0.0).cwiseMin(1.0).rowwise() + corner;
        if (!loops_apart(flats[k], places[k])) flats[k].one_to_one = false;
    });
    packed.margin = std::min(options.margin, std::max(0.0, margin - 2.0 * rim_slack));
    packed.tiles = tile.empty() ? 1 : 1 + *std::ranges::max_element(tile);
}

/// Lays the twins on their parts. @return whether all lie as they should; the others are no twins any more
bool lay_twins(std::vector<FlatPart>& flats, PackedParts& packed)
{
    bool all = true;
    for (std::size_t k = 0; k < flats.size(); ++k) {
        if (!packed.twins[k]) continue;
        const Twin& twin = *packed.twins[k];
        packed.places[k] = packed.places[twin.of](twin.vertex, Eigen::all);
        if (flats[twin.of].one_to_one && lies_as_twin(flats[k], twin, packed.places[k])) continue;
        packed.twins[k].reset();
        all = false;
    }
    for (std::size_t k = 0; all && k < flats.size(); ++k) {
        if (!packed.twins[k]) continue;
        flats[k].kind = flats[packed.twins[k]->of].kind;
        packed.anew[k] = packed.anew[packed.twins[k]->of];
    }
    return all;
}

}  // namespace

PackedParts pack_parts(std::vector<FlatPart>& flats, const PackOptions& options, ExecutionContext& context)
{
    PackedParts packed{std::vector<PlanarPoints>(flats.size()), std::vector<char>(flats.size(), 0),
                       std::vector<std::optional<Twin>>(flats.size())};
    if (!options.twins.empty()) packed.twins = options.twins;
    do pack_apart(flats, options, packed, context);
    while (!lay_twins(flats, packed));
    return packed;
}

}  // namespace koebe
