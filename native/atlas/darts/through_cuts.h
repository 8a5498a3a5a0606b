// Cuts through a relaxed part, from one place of its boundary to another.
#pragma once

#include "cost/costs.h"
#include "flat/flat_part.h"

#include <optional>
#include <vector>

namespace koebe {

/// Most Newton steps of the trials of cuts of a piece, or of all stitches, over the faces: a few times the usual.
inline constexpr double most_trial_work = 80.0;

/// Where a through cut begins and ends.
struct CutEnds {
    Eigen::RowVector3d from, to;
};

/// A path along edges. It joins two loops of a part, or splits the part in two.
struct ThroughCut {
    std::vector<Index> vertices;   ///< from boundary to boundary
    std::vector<Index> halfedges;  ///< each between two successive vertices, in either direction
    double length = 0.0;           ///< in roots of the surface's area, more where the surface is shown
    double forecast = 0.0;         ///< of the energy that it releases
    double cost = 0.0;             ///< in energy
    CutEnds ends;
};

/// Through cuts that may pay and can be opened together, the most promising cut first: a few between loops, apart from
/// each other, or one that splits the part. A cut releases at most about 2 (|F|^2 + 12 M^2 / L^2) / Y, like a beam that
/// breaks. F is the force between the two sides, summed along the path. M is the moment, about the middle of the path,
/// of the force that pulls the sides apart. L is the length of the path, and Y is the stiffness as for darts (darts.h).
/// The forecast is a quarter of this energy, as measured. Where a narrow band is drawn out round the part, it is the
/// energy of the whole band: one cut across releases all of it.
/// @param flat a part relaxed for this E @param refused cuts that did not pay: no cut near them
std::vector<ThroughCut> promising_through_cuts(const FlatPart& flat, double even, const ThroughPrice& price,
                                               const std::vector<CutEnds>& refused);

/// Cuts a part through. If the cut joins two loops, there is one piece: the sides of the cut are drawn a little apart.
/// If the cut splits the part, there are two pieces.
/// @return empty if the cut cannot be opened, or if a piece would be too small
std::vector<FlatPart> cut_through(const FlatPart& flat, const ThroughCut& cut);

/// A piece of a part, in its place in the map: sides of cuts lie on each other. It has no tips, and no lengths of cuts.
/// @param faces of the part @param triangles (F, 3) of the piece @param source (V) the part's vertex that each vertex
/// is
/// @return empty if the piece is no surface of genus 0 with a boundary
std::optional<FlatPart> opened_piece(const FlatPart& flat, const std::vector<Index>& faces, const Triangles& triangles,
                                     const std::vector<Index>& source);

}  // namespace koebe
