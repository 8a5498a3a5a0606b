// From the images of the loops to a map of the surface: circles, normal position, interior, even texels.
#pragma once

#include "circles/circle_map.h"
#include "circles/moebius.h"
#include "iteration/koebe_outcome.h"
#include "linear/boundary_solver.h"
#include "pipeline/map_input.h"

#include <optional>

namespace koebe {

/// What a map of a surface is made with.
struct MapSolver {
    BoundarySolver& boundary;  ///< of the Laplacian, its boundary the concatenation of the surface's loops
    const SparseMatrix& laplacian;
    const MapInput& input;
};

/// Circles fitted, two loops made concentric, the boundary put on its circles, the interior harmonic (balance_flux).
/// @param cut the flaps that will hang on the rim
/// @return of the surface's vertices; nothing if the circles leave the disk, meet, or no finite map extends them
std::optional<CircleMap> map_from_loops(const MapSolver& solver, const FlapCut& cut, const KoebeOutcome& outcome);

/// The map moved by an automorphism of the disk: its circles and the boundary on them, the interior harmonic again.
/// @return nothing if the circles leave the disk, meet, or no finite map extends them
std::optional<CircleMap> moved_by(const MapSolver& solver, const CircleMap& map, const Moebius& automorphism);

/// The map moved by the automorphism of the disk with the least area distortion (area_balance.h).
/// @return nothing if the circles leave the disk, meet, or no finite map extends them
std::optional<CircleMap> with_area_balanced(const MapSolver& solver, const CircleMap& map);

}  // namespace koebe
