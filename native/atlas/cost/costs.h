// What parts cost: one measure for uneven texels, bent angles, cuts, islands, exposure and room. Splitting, merging,
// hiding, mirroring, slits, darts, through cuts, cuts for room and unfolding ask it; tuning.h has its numbers.
//
// Before parts are flat, a cost is an *overflow*: area of the mesh, which is 1 in all, times u = 1/2 log(texel
// density):
//     cost = sum_parts (overflow + angle_cost) + part_price * parts + cut_price * length
// Once they are flat, it is an *energy* E_t (even/even_map.h), which counts angles and texels already:
//     cost = sum_parts energy + dart_price * (length + piece * parts) - room_worth * area saved in the square
// A cut is made if it lowers the cost. Lengths are in roots of the mesh's area, longer where the cut is seen.
#pragma once

#include "core/types.h"
#include "cost/tuning.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace koebe {

// Uneven texels and bent angles, in overflow

/// Texel densities within this factor count as even: log 3, in u.
inline constexpr double factor_three = 1.0986122886681098;

/// How far u lies outside the even window [from, from + even_range].
inline double off_window(double u, double from) { return std::max({from - u, u - from - tuning::even_range, 0.0}); }

/// A face's overflow per area: min(off_window, lost_cost). A lost face costs as much: the artist cannot paint on it.
inline double uneven_cost(double off) { return std::min(off, tuning::lost_cost); }

/// An overflow in which faces that are lost in the map of the parent cost little: their own map may have them.
/// max(overflow - (lost_cost - doubtful_cost) lost_area, 0)
inline double doubtful_overflow(double overflow, double lost_area)
{
    return std::max(overflow - (tuning::lost_cost - tuning::doubtful_cost) * lost_area, 0.0);
}

/// Angle errors: an error of 90 degrees everywhere is as bad as losing all faces. lost_cost (degrees / 90) area
inline double angle_cost(double degrees, double area) { return tuning::lost_cost * degrees / 90.0 * area; }

// Islands and cuts, in overflow

/// The prices of one more part, and of a cut as long as the root of the mesh's area.
struct CutPrices {
    double part_price = 0.0;
    double cut_price = 0.0;

    /// part_price parts + cut_price length
    double of(double parts, double length) const { return cut_price * length + part_price * parts; }
    /// The prices at which parts are split: some cuts pay only together with later cuts. Merging takes back those that
    /// do not pay at the whole prices.
    CutPrices eager() const { return {tuning::eager * part_price, tuning::eager * cut_price}; }
};

/// The prices in a piece. The user's price is for the whole mesh: with it a small piece would never be split, even if
/// it lost all its faces. Lengths are in roots of the whole's area, so cuts of a small piece are short:
///     part_price = s price,  cut_price = min(1, s / sqrt(area)) price,
/// where s is sqrt(area / own_price_area), at most 1, and in proportion to the area below small_area.
/// @param area of the piece; that of the mesh is 1
CutPrices prices_of_piece(double area, double price);

/// The most that a part may cost if it is not cut in two: max(part_price, hopeless area)
inline double most_uncut(double area, double part_price) { return std::max(part_price, tuning::hopeless * area); }

/// What a child will have cost after later splits: half of what lies above two prices is left, about.
/// c for c <= 2 p, else 2 p + later_share (c - 2 p)
double expected_cost(double cost, double part_price);

/// What parts that are their own mirror image may cost. @param cost of others
inline double most_cost_of_symmetric(double cost) { return tuning::symmetric_factor * cost; }

// Exposure: factors on the length of a cut

/// The factors at some vertices: 1 + (avoided_factor - 1) show. @param show (V) from 0 to 1: how much cuts are to keep
/// away; empty: 0 @return as `shown` in CutSurface
std::vector<double> cut_prices(const std::vector<double>& show, const std::vector<Index>& vertices);

/// The factor on an edge: the mean of its ends. @param shown (V) as in CutSurface
inline double price_of_edge(const std::vector<double>& shown, Index a, Index b)
{
    return shown.empty() ? 1.0 : 0.5 * (shown[a] + shown[b]);
}

/// Factors by visibility: (least_seen + seen) / (least_seen + mean). In the mean cuts are as dear as before.
/// @param seen (V) share of the directions from which a vertex is seen @param areas (V) weights of the mean
VectorXd visibility_factors(const VectorXd& seen, const VectorXd& areas);

/// Factors by detail, from 1 to most_detailed: the modeller spent vertices where people look. The root of the density,
/// over its mean, is about an edge's length over the edges' lengths there.
/// @param density (V) of vertices, per area @param areas (V) weights of the mean
VectorXd detail_factors(const VectorXd& density, const VectorXd& areas);

/// The weight of the energy of a face: what nobody sees may be uneven. min(1, shown / seen_well), at least
/// hidden_weight. @param shown as in CutSurface, in the mean of the face's corners
inline double weight_of_face(double shown) { return std::clamp(shown / tuning::seen_well, tuning::hidden_weight, 1.0); }

/// The factor on an edge whose mean curvature is so many standard deviations above the mean: hollows hide a cut.
/// exp(hollow_strength deviations), with deviations held to hollow_deviation
inline double hollow_factor(double deviations)
{
    return std::exp(tuning::hollow_strength *
                    std::clamp(deviations, -tuning::hollow_deviation, tuning::hollow_deviation));
}

// Darts and through cuts, in energy

/// The price of a cut as long as the root of the area: dart_unit / D. @param darts D, over 0 to 1
inline double dart_price(double darts) { return tuning::dart_unit / darts; }

/// A dart of a length, in energy. @param price of a dart as long as the root of the area @param is_new it lengthens no
/// other dart @param exposure factor on the length where it begins
inline double dart_cost(double price, double length, bool is_new, double exposure)
{
    return price * (length + (is_new ? tuning::new_dart * exposure : 0.0));
}

/// All cuts and parts of a layout, in energy: dart_price (length + piece parts). @param piece of one more part, as a
/// length
inline double layout_cost(double darts, double length, double piece, double parts)
{
    return dart_price(darts) * (length + piece * parts);
}

/// The price of one more part, as the length of a cut: the user's price over the one at which both are the same.
inline double part_as_length(double price) { return price / tuning::price_like_cut; }

/// The energy that a crack of infinite length releases: 2 T^2 / Y, with the stiffness Y = 8 t / (1 + t) of E_t against
/// stretching in one direction. @param pull T, the force between its sides @param even E
double crack_energy(double pull, double even);

/// The energy that a cut from boundary to boundary releases, like a beam that breaks: 2 (|F|^2 + 12 M^2 / L^2) / Y.
/// @param force F @param moment M, about the middle of the cut @param length L
double beam_energy(Complex force, double moment, double length, double even);

/// What through cuts and cuts for room cost, in energy.
struct ThroughPrice {
    double length = 0.0;          ///< of a cut as long as the root of the surface's area
    std::optional<double> piece;  ///< of one more piece, in addition to its cut; without a value no part is split
    double smooth = 1.0;  ///< factor on `length` of cuts for room, where the surface is bent by under 50 degrees

    /// Of a cut; infinite if it splits a part that must not be split.
    double of(double cut_length, bool splits) const
    {
        return length * cut_length + (splits ? piece.value_or(std::numeric_limits<double>::infinity()) : 0.0);
    }
};

/// Of cuts that make room in parts that are relaxed. @param piece price of one more part, as a length
inline ThroughPrice room_price(double darts, double piece)
{
    return {dart_price(darts), tuning::room_island * piece * dart_price(darts)};
}

/// Of cuts that make room between planar regions. Along a rolled face a cut costs ten times as much: a cone stays one
/// sector, a thin ring does not stay one.
inline constexpr ThroughPrice hard_room_price{tuning::hard_cut, tuning::hard_island, tuning::smooth_factor};

// Stitches, in energy

/// What a stitch saves: a cut, and the island that is one less, in proportion to the neck between the two.
/// @param length of the cut @param neck its length over the size of the smaller part
inline double stitch_saving(const ThroughPrice& price, double length, double neck)
{
    return price.length * length + tuning::stitched_island * price.piece.value_or(0.0) * std::min(1.0, neck);
}

/// What islands cost that become less like disks; 0 if they become more like them. @param compactness 4 pi A / L^2 of
/// the islands, in the mean of their areas
inline double roundness_loss(double compactness, double after)
{
    return tuning::roundness * std::max(0.0, compactness - after);
}

/// What room is worth. @param area in the square, in areas of the mesh
inline double room_gain(double area) { return tuning::room_worth * area; }

}  // namespace koebe
