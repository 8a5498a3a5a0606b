// Makes a map of the surface from the images of its loops: circles, normal position, interior, even texels.
#pragma once

#include "circles/circle_map.h"
#include "circles/moebius.h"
#include "iteration/koebe_outcome.h"
#include "linear/boundary_solver.h"
#include "pipeline/map_input.h"

#include <optional>

namespace koebe {

/// The solver, the Laplacian and the surface of a map.
struct MapSolver {
    BoundarySolver& boundary;  ///< of the Laplacian; its boundary is the concatenation of the surface's loops
    const SparseMatrix& laplacian;
    const MapInput& input;
};

/// Fits circles, makes two loops concentric, puts the boundary on its circles, makes the interior harmonic
/// (balance_flux).
/// @param cut the ears that will lie on the rim
/// @return a map of the surface's vertices; nothing if circles leave the disk or meet, or no finite map extends them
std::optional<CircleMap> map_from_loops(const MapSolver& solver, const EarCut& cut, const KoebeOutcome& outcome);

/// Moves the map by an automorphism of the disk: its circles and the boundary on them; the interior is harmonic again.
/// @return nothing if circles leave the disk or meet, or no finite map extends them
std::optional<CircleMap> moved_by(const MapSolver& solver, const CircleMap& map, const Moebius& automorphism);

/// Moves the map by the automorphism of the disk with the least area distortion (area_balance.h).
/// @return nothing if circles leave the disk or meet, or no finite map extends them
std::optional<CircleMap> with_area_balanced(const MapSolver& solver, const CircleMap& map);

}  // namespace koebe
