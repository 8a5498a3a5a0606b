// Checks that a map stays in the unit disk.
#pragma once

#include "core/types.h"

namespace koebe {

/// Throws if a map leaves the disk: negative weights of obtuse faces can carry vertices of a harmonic map out of it.
/// @throws SolverError a position is not finite, or outside the closed unit disk by more than rounding; elements:
/// vertices
void require_in_closed_disk(const VectorXcd& positions);

}  // namespace koebe
