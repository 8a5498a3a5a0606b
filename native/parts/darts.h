// Darts: cuts from a rim into a flat part. They make no island, and let a peak or a limb lie flat.
#pragma once

#include "execution/execution.h"
#include "parts/flat_part.h"
#include "relax/even_forces.h"

#include <vector>

namespace koebe {

/// A path along edges from a vertex inside a part to its boundary.
struct Dart {
    std::vector<Index> vertices;   ///< from the tip to the boundary
    std::vector<Index> halfedges;  ///< each from a vertex to the next one, or back
    double length = 0.0;           ///< on the surface
    double gain = 0.0;             ///< energy that it releases, foretold
    double cost = 0.0;             ///< less for a dart that lengthens another
};

/// The darts that may pay, some way apart. A dart is worth what its opening releases: with T the force by which the
/// two sides of the path are pulled apart, summed along it, and Y = 8 t / (1 + t) the stiffness of E_t
/// (relax/even_map.h) against being stretched one way, 2 T^2 / Y by the formula for a crack that runs in from the edge
/// of a plate.
///
/// @param flat relaxed for this E @param forces at its corners
/// @param price of a dart as long as the root of the surface's area, in energy
/// @param refused (V) 1 for vertices that are no tips
std::vector<Dart> promising_darts(const FlatPart& flat, const EvenForces& forces, double even, double price,
                                  const std::vector<char>& refused);

/// The shortest ways to the boundary from inner vertices, as long as they share no vertex.
std::vector<Dart> shortest_darts(const FlatPart& flat, const std::vector<Index>& tips);

/// Opens darts, no two of which share a vertex. Vertices keep their numbers, second sides get new ones, and both sides
/// are drawn a little apart.
/// @return false, nothing changed, where that cannot be
bool open_darts(FlatPart& flat, const std::vector<Dart>& darts);

/// The dart that is nearest to each face on the surface; -1 where none is near. @param reach (darts) how far a dart
/// counts
std::vector<int> nearest_dart(const FlatPart& flat, const std::vector<Dart>& darts, double reach);

}  // namespace koebe
