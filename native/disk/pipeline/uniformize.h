// The main entry: maps a surface with holes to a circle domain.
#pragma once

#include "core/api.h"
#include "execution/execution.h"
#include "pipeline/result.h"

namespace koebe {

/// Maps a surface of genus 0 with boundary loops conformally to the unit disk, every loop on a round circle.
///
/// One loop gives the Riemann map (paper, section 4.3), two loops the annulus centred at 0 (section 4.2), three and
/// more the Koebe iteration (section 4.4). The input is not changed. Faces keep their orientation: counter-clockwise
/// faces seen from outside have positive UV area, unless they are flipped.
///
/// @param vertices (V, 3) positions, any unit
/// @param triangles (F, 3) vertex indices
/// @throws InputError, TopologyError, SolverError, Cancelled; non-convergence is reported, not thrown
KOEBE_API UniformizeResult uniformize(const Vertices& vertices, const Triangles& triangles,
                                      const UniformizeOptions& options, ExecutionContext& context);

/// Maps on the calling thread: a cancel takes effect at the next checkpoint, not at once.
UniformizeResult uniformize_here(const Vertices& vertices, const Triangles& triangles, const UniformizeOptions& options,
                                 ExecutionContext& context);

/// Maps without progress reports or cancelling.
UniformizeResult uniformize(const Vertices& vertices, const Triangles& triangles,
                            const UniformizeOptions& options = {});

}  // namespace koebe
