#include "packing/tile_packing.h"

#include "core/errors.h"
#include "core/numbering.h"
#include "packing/packed_island.h"
#include "packing/sheet_packing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace koebe {
namespace {

constexpr double next_scale_of_tiles = 0.93;  // times the last while the tiles have no room,
constexpr int most_scales_of_tiles = 600;
constexpr int last_halvings = 4;             // of the last step
constexpr std::size_t many_on_tiles = 2000;  // islands: without halvings
constexpr int most_moves = 6;                // of islands between tiles
constexpr std::size_t most_moved = 300;      // islands: without moves beyond

/// The islands of one tile.
struct OneTile {
    std::vector<std::size_t> islands;
    IslandPacking packing{{}, std::numeric_limits<double>::infinity(), 0.0};
    double area = 0.0;
};

class TilePacker {
public:
    TilePacker(const std::vector<Outline>& outlines, double margin, int tiles, const PackingTime& time)
        : outlines_(outlines), margin_(margin), time_{time.is_over}, tiles_(static_cast<std::size_t>(tiles))
    {
        for (const Outline& outline : outlines) {
            const UprightIsland island = upright_island(outline);
            area_.push_back(std::max(island.area, 0.0));
            extent_ = std::max(extent_, island.extent);
        }
    }

    TilePacking pack()
    {
        spread();
        for (OneTile& tile : tiles_) fill(tile);
        if (outlines_.size() <= most_moved)
            for (int k = 0; k < most_moves && move_one(); ++k) {
            }
        TilePacking result;
        result.scale = tiles_[fullest()].packing.scale;
        result.margin = margin_;
        result.places.resize(outlines_.size());
        result.tile.assign(outlines_.size(), 0);
        for (std::size_t t = 0; t < tiles_.size(); ++t) {
            OneTile& tile = tiles_[t];
            // A tile with more room is made smaller, and its margin with it: then islands lie further apart at first.
            if (const double smaller = result.scale / tile.packing.scale; smaller < 1.0 && !tile.islands.empty())
                if (IslandPacking wider = pack_islands(outlines_of(tile), margin_ / smaller, time_);
                    wider.scale >= result.scale)
                    tile.packing = std::move(wider);
            const double factor = result.scale / tile.packing.scale;
            if (!tile.islands.empty()) result.margin = std::min(result.margin, factor * tile.packing.margin);
            for (std::size_t i = 0; i < tile.islands.size(); ++i) {
                result.places[tile.islands[i]] = tile.packing.places[i];
                result.places[tile.islands[i]].offset *= factor;
                result.tile[tile.islands[i]] = static_cast<int>(t);
            }
        }
        return result;
    }

private:
    std::optional<SheetPacking> on_sheets(double scale) const
    {
        SheetPacking sheets = pack_on_sheets(outlines_, margin_ / scale, {1.0 / scale, 1.0 / scale});
        const bool has_room = sheets.sheets <= static_cast<int>(tiles_.size()) &&
                              std::ranges::none_of(sheets.sheet, [](int sheet) { return sheet < 0; });
        return has_room ? std::optional(std::move(sheets)) : std::nullopt;
    }

    /// Spreads the islands over the tiles at the largest scale found.
    void spread()
    {
        // The largest scale at which an island fits on a tile, and all areas on all tiles. Smaller ones, until they
        // fit.
        double area = 0.0;
        for (const double own : area_) area += own;
        const double room = std::sqrt(static_cast<double>(tiles_.size()) / area);
        double scale = std::min((1.0 - margin_) / extent_, room);
        std::optional<SheetPacking> best;
        for (int k = 0; !(best = on_sheets(scale)); scale *= next_scale_of_tiles)
            if (++k == most_scales_of_tiles) throw SolverError("the islands have no room on the tiles");
        // Bisection of its logarithm between the last two.
        double step = 1.0 / next_scale_of_tiles;
        for (int k = 0; k < last_halvings && outlines_.size() <= many_on_tiles; ++k) {
            step = std::sqrt(step);
            if (std::optional<SheetPacking> larger = on_sheets(scale * step)) {
                best = std::move(larger);
                scale *= step;
            }
        }
        // Note each island on its tile.
        for (std::size_t i = 0; i < outlines_.size(); ++i) {
            OneTile& tile = tiles_[static_cast<std::size_t>(best->sheet[i])];
            tile.islands.push_back(i);
            tile.area += area_[i];
            IslandPlace place = best->places[i];
            place.offset *= scale;
            tile.packing.places.push_back(place);
            tile.packing.scale = scale;
            tile.packing.margin = margin_;
        }
    }

    std::vector<Outline> outlines_of(const OneTile& tile) const { return values_at(outlines_, tile.islands); }

    /// Packs the islands of a tile by themselves, unless they lie better already.
    void fill(OneTile& tile) const
    {
        if (tile.islands.empty()) return;
        IslandPacking packing = pack_islands(outlines_of(tile), margin_, time_);
        const bool is_new = tile.packing.places.size() != tile.islands.size();
        if (is_new || packing.scale > tile.packing.scale) tile.packing = std::move(packing);
    }

    std::size_t fullest() const
    {
        return static_cast<std::size_t>(
            std::ranges::min_element(tiles_, {}, [](const OneTile& tile) { return tile.packing.scale; }) -
            tiles_.begin());
    }

    /// Moves an island from the fullest tile to the one with most room. @return whether islands became larger
    bool move_one()
    {
        const std::size_t from = fullest();
        const auto to = static_cast<std::size_t>(
            std::ranges::max_element(tiles_, {}, [](const OneTile& tile) { return tile.packing.scale; }) -
            tiles_.begin());
        if (from == to || tiles_[from].islands.size() < 2) return false;
        OneTile left{{}, {{}, 0.0, 0.0}, tiles_[from].area}, filled = tiles_[to];
        const double wanted = 0.5 * (left.area - filled.area);  // that leaves both as full
        const auto chosen = *std::ranges::min_element(tiles_[from].islands, {},
                                                      [&](std::size_t i) { return std::abs(area_[i] - wanted); });
        std::ranges::copy_if(tiles_[from].islands, std::back_inserter(left.islands),
                             [&](std::size_t i) { return i != chosen; });
        filled.islands.push_back(chosen);
        left.area -= area_[chosen];
        filled.area += area_[chosen];
        fill(left);
        fill(filled);
        if (!(std::min(left.packing.scale, filled.packing.scale) > tiles_[from].packing.scale)) return false;
        tiles_[from] = std::move(left);
        tiles_[to] = std::move(filled);
        return true;
    }

    const std::vector<Outline>& outlines_;
    const double margin_;
    const PackingTime time_;
    std::vector<double> area_;  // of the islands
    double extent_ = 0.0;
    std::vector<OneTile> tiles_;
};

}  // namespace

TilePacking pack_on_tiles(const std::vector<Outline>& outlines, double margin, int tiles, const PackingTime& time)
{
    require_finite_outlines(outlines);
    margin = std::min(margin, most_margin(outlines.size() / static_cast<std::size_t>(tiles)));
    const auto has_area = [](const Outline& outline) { return upright_island(outline).area > 0.0; };
    if (tiles > 1 && std::ranges::any_of(outlines, has_area)) return TilePacker(outlines, margin, tiles, time).pack();
    return {pack_islands(outlines, margin, time), std::vector<int>(outlines.size(), 0)};
}

int tiles_for(const std::vector<Outline>& outlines, double margin, double scale)
{
    const SheetPacking sheets = pack_on_sheets(outlines, margin / scale, {1.0 / scale, 1.0 / scale});
    const bool has_room = std::ranges::none_of(sheets.sheet, [](int sheet) { return sheet < 0; });
    return has_room ? std::clamp(sheets.sheets, 1, most_tiles) : most_tiles;
}

TilePacking shrunk(TilePacking packing, double factor)
{
    for (IslandPlace& place : packing.places) place.offset *= factor;
    packing.scale *= factor;
    packing.margin *= factor;
    return packing;
}

}  // namespace koebe
