// A surface of genus 1 on a flat torus, its holes round.
#pragma once

#include "execution/execution.h"
#include "iteration/iteration_options.h"
#include "iteration/koebe_outcome.h"
#include "tiles/flat_map.h"

namespace koebe {

/// The conformal map to C / (Z + tau Z), |Re tau| <= 1/2 and |tau| >= 1, holes on circles.
///
/// Every hole is filled by a round disk of closed form, given by one angle for each vertex of the loop, as in the
/// condensed engine (docs/method.md). The filled surface is a closed torus: two harmonic 1-forms with the periods
/// (1, 0) and (0, 1) and the energies E give tau = (-E_12 + i sqrt(det E)) / E_22 and the map. The image of a loop
/// would be a circle if its angles were right. The fixed point theta <- arg(z - c) halves each error of a single hole,
/// so a sweep goes twice as far: theta <- 2 arg(z - c) - theta, which leaves to first order only what the holes and
/// their copies do to each other.
///
/// @param domain of periodic_torus; its shifts are exchanged for those of the reduced periods
/// @return the loops on their circles, if these are apart; periods 1 and tau
/// @throws SolverError, Cancelled
FlatMap torus_circles(PeriodicSurface& domain, const IterationOptions& options, ExecutionContext& context);

}  // namespace koebe
