#include "flatten/sheets.h"

#include "core/errors.h"
#include "flatten/page_turn.h"
#include "packing/packed_island.h"
#include "planar/planar_predicates.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

namespace koebe {
namespace {

constexpr double gap = 3.0;                // mm between pieces with their allowances
constexpr double least_gap_share = 0.02;   // of a sheet without page: small pieces have a smaller gap
constexpr double larger_sheet = 1.05;      // where pieces have no room on one: at least,
constexpr double largest_step = 1.5;       // and at most
constexpr std::size_t many_pieces = 1000;  // whose margins take much of the sheet, and whose packing takes long,
constexpr double room_of_many = 1.3;       // begin on a sheet so much larger than the boxes say
constexpr int most_pages = 1000;

/// The side of a square in which the pieces have about room.
double square_for(const std::vector<PieceShape>& pieces, double margin)
{
    double area = 0.0, longest = 0.0;
    for (const PieceShape& piece : pieces) {
        const Eigen::RowVector2d size = box_size(piece.points);
        area += 0.6 * (size[0] + margin) * (size[1] + margin);
        longest = std::max(longest, size.norm());
    }
    return std::max(std::sqrt(area), 0.7 * longest + margin);
}

std::vector<Outline> outlines_of(const std::vector<PieceShape>& pieces)
{
    std::vector<Outline> outlines;
    for (const PieceShape& piece : pieces) outlines.push_back({piece.points, piece.loops});
    return outlines;
}

class Placing {
public:
    Placing(const std::vector<PieceShape>& pieces, double allowance, const Page& page)
        : pieces_(pieces), allowance_(allowance)
    {
        placed_.pattern.page = page;
        placed_.points.resize(pieces.size());
        placed_.sheet.resize(pieces.size());
    }

    PlacedPieces place()
    {
        if (page().any())
            on_pages();
        else
            on_one_sheet();
        return std::move(placed_);
    }

private:
    const Page& page() const { return placed_.pattern.page; }
    double frame_width() const { return page().width - 2.0 * page().margin; }
    double frame_height() const { return page().height - 2.0 * page().margin; }
    double margin() const { return 2.0 * allowance_ + gap; }

    void on_one_sheet()
    {
        const std::vector<Outline> outlines = outlines_of(pieces_);
        // A square that should have room.
        double side = square_for(pieces_, 2.0 * allowance_);
        const double margin = 2.0 * allowance_ + std::min(gap, least_gap_share * side);
        if (pieces_.size() >= many_pieces) side = std::max(side, room_of_many * square_for(pieces_, margin));
        SheetPacking packing = pack_on_sheets(outlines, margin, {side, side});
        // Larger ones, by the share of the area that found a place.
        while (packing.sheets != 1 || std::ranges::count(packing.sheet, -1) > 0) {
            side *= std::clamp(std::sqrt(1.0 / share_on_first(packing)), larger_sheet, largest_step);
            packing = pack_on_sheets(outlines, margin, {side, side});
        }
        // The sheet is the box of what was placed.
        placed_.pattern.sheets.emplace_back();
        Eigen::RowVector2d low = Eigen::RowVector2d::Constant(INFINITY), high = -low;
        for (std::size_t k = 0; k < pieces_.size(); ++k) {
            const PlanarPoints at = place_island(pieces_[k].points, packing.places[k], 1.0);
            low = low.cwiseMin(at.colwise().minCoeff());
            high = high.cwiseMax(at.colwise().maxCoeff());
        }
        PatternSheet& sheet = placed_.pattern.sheets.back();
        sheet.width = high[0] - low[0] + margin;
        sheet.height = high[1] - low[1] + margin;
        const Complex shift(0.5 * margin - low[0], 0.5 * margin - low[1]);
        for (std::size_t k = 0; k < pieces_.size(); ++k) {
            packing.places[k].offset += shift;
            place_piece(k, packing.places[k], 0);
        }
    }

    /// Of the boxes of the pieces, by area.
    double share_on_first(const SheetPacking& packing) const
    {
        double first = 0.0, all = 0.0;
        for (std::size_t k = 0; k < pieces_.size(); ++k) {
            const double box = box_size(pieces_[k].points).prod();
            all += box;
            if (packing.sheet[k] == 0) first += box;
        }
        return all > 0.0 ? first / all : 1.0;
    }

    /// Packs the pieces. One that fits the frame in few turns only is turned so first.
    SheetPacking packed() const
    {
        std::vector<Outline> outlines = outlines_of(pieces_);
        std::vector<Complex> turns(outlines.size(), 1.0);
        for (std::size_t k = 0; k < outlines.size(); ++k) {
            if (upright_fits(outlines[k])) continue;
            const std::optional<Complex> turn =
                turn_into(outlines[k].points, frame_width() - margin(), frame_height() - margin());
            if (!turn) continue;
            turns[k] = *turn;
            outlines[k].points = place_island(outlines[k].points, {.turn = *turn}, 1.0);
            outlines[k].along_axes = true;
        }
        SheetPacking packing = pack_on_sheets(outlines, margin(), {frame_width(), frame_height()});
        for (std::size_t k = 0; k < turns.size(); ++k) packing.places[k].turn *= turns[k];
        return packing;
    }

    bool upright_fits(const Outline& outline) const
    {
        const Eigen::RowVector2d size = box_size(upright_island(outline).points);
        const double width = frame_width() - margin(), height = frame_height() - margin();
        return (size[0] <= width && size[1] <= height) || (size[1] <= width && size[0] <= height);
    }

    void on_pages()
    {
        const SheetPacking packing = packed();
        std::vector<std::size_t> large;
        placed_.pattern.sheets.resize(static_cast<std::size_t>(packing.sheets),
                                      {frame_width(), frame_height(), 1, 1, {}, {}});
        double pages = packing.sheets;
        for (std::size_t k = 0; k < pieces_.size(); ++k)
            if (packing.sheet[k] < 0) {
                large.push_back(k);
                pages += pages_for(place_island(pieces_[k].points, packing.places[k], 1.0));
            }
        if (!(pages <= most_pages))
            throw InputError("the pattern needs " + std::to_string(static_cast<long long>(std::min(pages, 1e15))) +
                             " pages: choose a larger page or none, and the units that the mesh has");
        for (std::size_t k = 0; k < pieces_.size(); ++k)
            if (packing.sheet[k] >= 0) place_piece(k, packing.places[k], packing.sheet[k]);
        for (const std::size_t k : large) put_on_own_sheet(k, packing.places[k]);
    }

    /// @param length of a piece with its margin
    static double tiles(double length, double frame) { return std::ceil(length / frame - page_slack); }

    double pages_for(const PlanarPoints& at) const
    {
        const Eigen::RowVector2d size = box_size(at);
        const auto pages = [&](int k) {
            return tiles(size[k] + margin(), frame_width()) * tiles(size[1 - k] + margin(), frame_height());
        };
        return std::min(pages(0), pages(1));
    }

    /// Upright, or along, whichever takes fewer pages.
    void put_on_own_sheet(std::size_t k, IslandPlace island)
    {
        PlanarPoints at = place_island(pieces_[k].points, island, 1.0);
        Eigen::RowVector2d size = box_size(at);
        const auto columns = [&] { return tiles(size[0] + margin(), frame_width()); };
        const auto rows = [&] { return tiles(size[1] + margin(), frame_height()); };
        if (columns() * rows() > pages_for(at)) {
            std::swap(size[0], size[1]);
            island.turn *= Complex(0.0, 1.0);
        }
        PatternSheet sheet{0.0, 0.0, static_cast<int>(columns()), static_cast<int>(rows()), {}, {}};
        sheet.width = sheet.columns * frame_width();
        sheet.height = sheet.rows * frame_height();
        island.offset = 0.0;
        at = place_island(pieces_[k].points, island, 1.0);
        const Eigen::RowVector2d low = at.colwise().minCoeff();
        island.offset = 0.5 * Complex(sheet.width - size[0], sheet.height - size[1]) - Complex(low[0], low[1]);
        placed_.pattern.sheets.push_back(std::move(sheet));
        place_piece(k, island, static_cast<int>(placed_.pattern.sheets.size()) - 1);
    }

    void place_piece(std::size_t k, const IslandPlace& island, int sheet)
    {
        const PieceShape& piece = pieces_[k];
        const PlanarPoints& at = placed_.points[k] = place_island(piece.points, island, 1.0);
        placed_.sheet[k] = sheet;
        std::vector<PatternLine>& lines = placed_.pattern.sheets[static_cast<std::size_t>(sheet)].lines;
        const int number = static_cast<int>(k) + 1;
        for (const PlanarPoints& ring : piece.allowance)
            lines.push_back({LineKind::cut, number, true, place_island(ring, island, 1.0)});
        const LineKind kind = piece.allowance.empty() ? LineKind::cut : LineKind::seam;
        for (const VertexLoop& loop : piece.loops) lines.push_back({kind, number, true, at(loop, Eigen::all)});
    }

    const std::vector<PieceShape>& pieces_;
    double allowance_;
    PlacedPieces placed_;
};

}  // namespace

int Pattern::pages() const
{
    return std::accumulate(sheets.begin(), sheets.end(), 0,
                           [](int sum, const PatternSheet& sheet) { return sum + sheet.pages(); });
}

PlacedPieces place_pieces(const std::vector<PieceShape>& pieces, double allowance, const Page& page)
{
    return Placing(pieces, allowance, page).place();
}

}  // namespace koebe
