// The paper's normalization: a vertex inside the surface at 0, one of the outer loop at 1 (section 4.3).
#pragma once

#include "circles/circle_map.h"
#include "circles/moebius.h"
#include "execution/execution.h"
#include "pipeline/map_from_loops.h"
#include "pipeline/map_input.h"

#include <vector>

namespace koebe {

/// The map moved by z -> (z - a) / (1 - conj(a) z) on its circles, the interior harmonic again, so that the surface's
/// centre lies at 0 up to the mesh's resolution: a Moebius map commutes with the extension only up to that, so a is
/// found in a few rounds. Neither a strong automorphism turns thin faces over then, nor is the rotation another.
/// @param solver of the core, or of the whole surface without flaps @param map of the solver's surface
/// @return the best that was found, map itself if nothing is better
CircleMap with_center_moved(const MapSolver& solver, const MapInput& whole, const FlapCut& cut, const CircleMap& map,
                            ExecutionContext& context);

/// An automorphism of the disk, exactly and vertex by vertex. @param map of the whole surface, changed in place
void move_points(const MapInput& whole, const Moebius& moebius, CircleMap& map);

/// The rest, exactly and vertex by vertex: the automorphism that sends the surface's centre to 0 and its point to 1.
/// Nothing if the surface names neither.
/// @param map of the whole surface, changed in place
void put_in_place(const MapInput& whole, CircleMap& map);

/// The surface's centre and point, as far as it names them: vertices that stay where put_in_place has put them.
std::vector<Index> held_vertices(const MapInput& whole);

}  // namespace koebe
