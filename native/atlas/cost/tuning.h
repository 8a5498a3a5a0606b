// The numbers that were chosen, not derived: by them a cut pays or does not. Each row has the unit, the meaning, and
// where the value comes from; "chosen" means that no measurement is kept. costs.h has the formulas, and
// docs/developers/costs.md prints both. tolerances.h says what counts as flat, straight and similar. Limits of the
// effort stand where they are used.
#pragma once

namespace koebe::tuning {

// Uneven texels. u = 1/2 log(UV area / area), overflow in area times u.
/// u | width of the even window | 0.8 log 3: texels within a factor 3 are even, less a fifth for rounding
inline constexpr double even_range = 0.8 * 1.0986122886681098;
/// u | most that a face costs, and what a lost face costs | prototype
inline constexpr double lost_cost = 6.0;
/// u | a face lost in the map of the parent: its own map may have it | chosen
inline constexpr double doubtful_cost = 0.25;
/// of a cost above two prices | what is left after later splits | prototype
inline constexpr double later_share = 0.6;
/// of even_range | width of the windows that are proposed as parts | prototype
inline constexpr double window_share = 0.85;
/// overflow over area | so uneven that any cut in two is better than none | chosen
inline constexpr double hopeless = 1.0;
/// overflow over area | what repairs may add without a price | chosen
inline constexpr double free_unevenness = 0.5;

// Bent angles.
/// degrees | what repairs may add without a price | chosen
inline constexpr double free_bend = 5.0;
/// of the angle error at E = 0 | what parts carried from a proxy may have until they are relaxed | chosen
inline constexpr double carried_error = 1.1;

// Islands. The user's price is that of one more island, in overflow.
/// of the area | in smaller pieces parts cost less | chosen
inline constexpr double own_price_area = 0.25;
/// of the area | smaller regions and pieces do not count | chosen
inline constexpr double small_area = 0.01;
/// of the area | the smallest plate, and the smallest piece of a through cut | chosen
inline constexpr double least_piece = 0.002;
/// of a part's area | a larger child leaves only a small part beside it | chosen
inline constexpr double nearly_all = 0.9;
/// of the prices | at these parts are split; they are merged at the whole prices | a person's cuts: comparison.md
inline constexpr double eager = 0.37;
/// overflow | the price at which one more flat part costs as much as a cut of length 1 | as eager
inline constexpr double price_like_cut = 0.0037;
/// of the cost | what parts that are mirror images of each other may cost | chosen
inline constexpr double symmetric_factor = 2.0;
/// prices | most that hiding a border may cost | chosen
inline constexpr double little_price = 0.1;
/// prices | one more island that makes room | 29 models: parts.md#packing
inline constexpr double room_island = 0.033;

// Cuts. Lengths are in roots of the area.
/// factor | on a cut where `show` is 1, or which runs along a rim | cuts in front of a ball 7.4 -> 3.4 radii
inline constexpr double avoided_factor = 8.0;
/// of the directions | added to what is seen of a vertex: what a hidden cut costs | chosen
inline constexpr double least_seen = 0.05;
/// factor | on a cut where the mesh is finest, as in a face | cuts of a face from the eyes to the mouth: gone
inline constexpr double most_detailed = 3.0;
/// of the directions | what is seen of a pocket; in its depth half, up to its rim twice | a body's face stays whole
inline constexpr double pocket_seen = 0.2;
/// area over squared rim | the shallowest pocket: a hemisphere has 0.16 | as pocket_seen
inline constexpr double pocket_depth = 0.3;
/// of the mesh's area | the smallest pocket that becomes an island | the sockets of the body's eyes have twice as much
inline constexpr double least_pocket = 0.001;
/// area over squared rim | above it a surface between cuts is halved first, as closed ones are | as pocket_seen
inline constexpr double nearly_closed = 5.0;
/// length | within which the fineness of the mesh is averaged | as most_detailed
inline constexpr double detail_scale = 0.06;
/// factor of visibility | below it the energy of a face counts less | 14 models: cuts 4.15 -> 3.84
inline constexpr double seen_well = 0.9;
/// factor | the least on the energy of a face that nobody sees | as seen_well
inline constexpr double hidden_weight = 0.15;
/// log of a factor | on a cut's length, for a standard deviation of the curvature | 30 models: hollows 32 -> 38 %
inline constexpr double hollow_strength = 0.5;
/// standard deviations | that count | as hollow_strength
inline constexpr double hollow_deviation = 1.5;
/// length | the size of the hollows that count | as hollow_strength
inline constexpr double hollow_scale = 0.03;
/// length | half the width in which a border may move | as hollow_strength
inline constexpr double hidden_band = 0.08;
/// of a part's area | what stays in the part while its border moves | as hollow_strength
inline constexpr double hidden_core = 0.6;
/// of a length, area, energy or angle error | less is not noticed: no cut is moved, made or lengthened for it | chosen
inline constexpr double noticeable = 0.02;
/// length | half the width of the band in which a cut is straightened | 15 models: comparison.md#straight
inline constexpr double straight_band = 0.03;
/// of an edge's length | a right angle in a cut | as straight_band
inline constexpr double turn_cost = 2.0;
/// length | a piece unfolded with shorter cuts is not tried otherwise | cuts of a box, a tin, a pencil
inline constexpr double few_cuts = 3.6;

// Darts and through cuts, in energy.
/// energy | a cut of length 1 with --darts 1 | 0.2: texels even to 1.1; 0.02: cuts as long as a person's
inline constexpr double dart_unit = 1e-4;
/// length | a new dart counts as longer by this | chosen
inline constexpr double new_dart = 0.03;
/// of the bound | expected of a through cut, and of a dart that begins at a round loop | measured: about a quarter
inline constexpr double released_share = 0.25;
/// energy over area | a region of faces above it may be released by one cut | wasted texels of 3 models: 8 to 14 -> 0 %
inline constexpr double strained = 1.0;
/// energy over area | a part with more is stuck: it is mapped anew, or gets darts without a mirror image | chosen
inline constexpr double stuck = 0.25;
/// of a length | a cut unloads the surface beside it so far | chosen
inline constexpr double cut_reach = 0.25;
/// length | between tips of darts, or through cuts, opened together; from round loops to other darts | chosen
inline constexpr double dart_spacing = 0.12;
/// length | of the longest dart | chosen
inline constexpr double longest_dart = 0.5;
/// length | of the longest through cut | a crumpled body of needles: angles 22 degrees, 43 without
inline constexpr double longest_through = 1.5;
/// E | at which darts are opened if no E is given, and maps are compared | chosen
inline constexpr double dart_even = 0.1;
/// factor | on cuts of a proxy: coarse parts bend in fewer places, and overrate them | 25 models: parts.md#packing
inline constexpr double proxy_factor = 2.0;

// Stitches, in energy.
/// of one more part | what an island costs beside another, joined to it by a neck as wide as itself | 14 models
inline constexpr double stitched_island = 0.12;
/// energy | of islands that are all disks, over islands without area | 14 models: islands 5.5 -> 3.8
inline constexpr double roundness = 0.3;
/// energy over area | of two sides of a border that are joined, over their mean square distance | chosen
inline constexpr double bent_border = 0.5;
/// of the area | what a stitch may add to texels four times too dense | chosen
inline constexpr double wasted_texels = 0.01;

// Room in the square.
/// energy | of a square as large as the surface | 29 models: coverage 57 -> 69 %, cuts 5 % longer
inline constexpr double room_worth = 0.005;
/// area | no part that fits into this square is shortened | as room_worth
inline constexpr double least_square = 1.45;
/// energy | a cut of length 1 between planar regions: it has to save 2 % of the area | 24 models: coverage 63 -> 73 %
inline constexpr double hard_cut = 1e-4;
/// energy | one more island of planar regions: it has to save 1 % | as hard_cut: cuts 6 % longer
inline constexpr double hard_island = 5e-5;
/// factor | on cuts between planar regions that meet at less than 50 degrees: a cone stays one sector | as hard_cut
inline constexpr double smooth_factor = 10.0;
/// length | of the longest island of planar regions | the side of a square that is covered to 75 %
inline constexpr double longest_hard = 1.155;
/// of the square | a single island that covers less is tried in more islands | the cross of a cube
inline constexpr double packed_badly = 0.45;
/// factor | on texels: more islands are taken if they are so much larger | the cross of a cube
inline constexpr double worth_apart = 1.18;
/// power of the number | by which texels must grow if hard parts are cut for room | twice as many cover 15 % more
inline constexpr double larger_by_count = 0.1;

}  // namespace koebe::tuning
