// Places small holes where the harmonic extension wants them.
#pragma once

#include "circles/circle.h"
#include "linear/boundary_solver.h"

#include <vector>

namespace koebe {

/// Whether two loops stay concentric.
enum class AnnulusPosition { concentric, free };

/// Moves, turns and scales small circles to the least conformal energy of the harmonic extension, E = 1/2 z* Sigma z -
/// area. Then no net flux runs through them, as in a conformal map. Centres from a fit or from a Moebius map are off by
/// an absolute amount: a Moebius map commutes with the extension only up to the mesh's resolution. A hole at the end of
/// a long limb is smaller than that, and the flux to it would drag the limb across the map. E is quadratic in a centre
/// and a complex radius, so this is one small linear system. Circles that would move little, or would meet, stay.
///
/// Two loops that must be concentric: moves the inner circle alone, and makes the pair concentric again. Repeats both
/// until the pair is concentric and without flux.
/// @param laplacian of the same surface as `condensed`
/// @param loops the outer one first, `boundary` (m, 2) their images in that order, on the circles
/// @return (V, 2) the harmonic extension of the boundary
PlanarPoints balance_flux(BoundarySolver& condensed, const SparseMatrix& laplacian,
                          const std::vector<VertexLoop>& loops, std::vector<Circle>& circles, MatrixXd& boundary,
                          AnnulusPosition annulus);

}  // namespace koebe
