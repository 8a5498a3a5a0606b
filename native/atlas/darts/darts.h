// Darts: cuts from a rim into a flat part. They make no island, and let a peak or a limb lie flat.
#pragma once

#include "even/even_forces.h"
#include "execution/execution.h"
#include "flat/flat_part.h"

#include <optional>
#include <vector>

namespace koebe {

/// A path along edges from a vertex inside a part to its boundary.
struct Dart {
    std::vector<Index> vertices;   ///< from the tip to the boundary
    std::vector<Index> halfedges;  ///< each between two successive vertices, in either direction
    double length = 0.0;           ///< on the surface
    double gain = 0.0;             ///< forecast of the energy that the dart releases
    double cost = 0.0;             ///< in energy; less for a dart that lengthens another dart
};

/// The darts that may pay, at some distance from each other. Opening a dart releases about 2 T^2 / Y, as for a crack
/// that runs in from the edge of a plate. T is the force that pulls the two sides of the path apart, summed along the
/// path. Y = 8 t / (1 + t) is the stiffness of E_t (even/even_map.h) against stretching in one direction.
///
/// @param flat a part relaxed for this E @param forces the forces at its corners
/// @param price price, in energy, of a dart as long as the root of the surface's area
/// @param refused (V) 1 for vertices that must not be tips
std::vector<Dart> promising_darts(const FlatPart& flat, const EvenForces& forces, double even, double price,
                                  const std::vector<char>& refused);

/// Opens darts. No two darts share a vertex. A dart with its tip on the boundary joins two loops: it is a slit. One
/// side of a dart keeps its vertices, and the other side gets new vertices. Both sides are drawn a little apart.
/// @return (V) the old number of each vertex. No value if the darts cannot be opened: then nothing changes
std::optional<std::vector<Index>> open_darts(FlatPart& flat, const std::vector<Dart>& darts);

/// Draws the two sides of open cuts a little apart, where they lie on each other.
/// @param moves (V) 1 for vertices of the cuts, but not for their tips @param gap between the sides, over the least
/// height of a face beside them; less where that overlaps @return false: it overlaps anyhow, and nothing changes
bool draw_apart(FlatPart& flat, const std::vector<char>& moves, double gap = 0.05);

/// For each face the cut nearest to it on the surface; -1 if no cut is within reach. @param cuts (cuts) vertices of
/// each
std::vector<int> nearest_cut(const FlatPart& flat, const std::vector<std::vector<Index>>& cuts, double reach);

}  // namespace koebe
