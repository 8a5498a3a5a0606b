// Small holes placed where no flux runs to them.
#pragma once

#include "conformal/result.h"
#include "geometry/condensed_laplacian.h"

#include <vector>

namespace koebe {

/// Moves small circles, as they are, so that the harmonic extension of the boundary has no net flux through them, as a
/// conformal map has none. Where their centres come from a fit, or from a Moebius map, which commutes with the extension
/// up to the resolution of the mesh only, they are off by an absolute amount; a hole at the end of a long limb is
/// smaller than that, and the flux to it would drag the limb across the map. With two loops the circles are then made
/// concentric again, and so on until they are both: concentric and without flux.
/// @param laplacian of the same surface as `condensed`
/// @param loops the outer one first, `boundary` (m, 2) their images in that order, on the circles
void balance_flux(const CondensedLaplacian& condensed, const SparseMatrix& laplacian,
                  const std::vector<VertexLoop>& loops, std::vector<Circle>& circles, MatrixXd& boundary);

}  // namespace koebe
