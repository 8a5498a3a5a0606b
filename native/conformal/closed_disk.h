// What a map to the unit disk must not do.
#pragma once

#include "core/types.h"

namespace koebe {

/// Negative weights of obtuse faces can carry vertices of a harmonic map out of the disk.
/// @throws SolverError a position is not finite, or is outside the closed unit disk by more than rounding (vertices
///         listed)
void require_in_closed_disk(const VectorXcd& positions);

}  // namespace koebe
