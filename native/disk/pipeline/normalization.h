// The paper's normalization: an inner vertex at 0, a vertex of the outer loop at 1 (section 4.3).
#pragma once

#include "circles/circle_map.h"
#include "circles/moebius.h"
#include "execution/execution.h"
#include "pipeline/map_from_loops.h"
#include "pipeline/map_input.h"

#include <vector>

namespace koebe {

/// Moves the map by z -> (z - a) / (1 - conj(a) z) on its circles, makes the interior harmonic again, and so brings the
/// surface's centre to 0. A Moebius map commutes with the extension only up to the mesh's resolution, so a is found in
/// a few rounds. In this way a strong automorphism turns no thin faces over, and the rotation does not change.
/// @param solver of the core, or of the whole surface without ears @param map of the solver's surface
/// @return the best map found, or `map` itself if no other is better
CircleMap with_center_moved(const MapSolver& solver, const MapInput& whole, const EarCut& cut, const CircleMap& map,
                            ExecutionContext& context);

/// Moves each vertex by an automorphism of the disk, exactly. @param map of the whole surface, changed in place
void move_points(const MapInput& whole, const Moebius& moebius, CircleMap& map);

/// Moves each vertex by the automorphism that sends the surface's centre to 0 and its point to 1, exactly. Does nothing
/// if the surface has neither.
/// @param map of the whole surface, changed in place
void normalize(const MapInput& whole, CircleMap& map);

/// The surface's centre and point, if it has them: vertices that stay where normalize has put them.
std::vector<Index> held_vertices(const MapInput& whole);

}  // namespace koebe
