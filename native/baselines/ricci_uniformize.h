// The Ricci flow as a rival of uniformize: the same input, the same report.
#pragma once

#include "baselines/ricci_flow.h"
#include "execution/execution.h"
#include "pipeline/result.h"

namespace koebe {

struct RicciOptions {
    UniformizeOptions
        common;  ///< outer, center, point, tolerance, max_sweeps (updates of the target) and threads count
    Packing packing = Packing::inversive;
    BoundaryTarget target = BoundaryTarget::inscribed;
    bool delaunay = true;  ///< flip the surface's edges to intrinsic Delaunay first, as uniformize does
};

/// Maps a surface with holes to a circle domain by the discrete Ricci flow (baselines/ricci_flow.h).
///
/// Before and after it is what uniformize does: flaps cut off first and hung back, flipped faces untangled, two loops
/// made concentric; only where curvature is left the flips stay. The flow's own map is neither put on circles nor
/// balanced. Method and engine of the result are those of the options and mean nothing. The warnings say by how much
/// the packing has changed the metric, how many faces the flow's own map flips, and why it has not converged.
/// @throws InputError, TopologyError, SolverError, Cancelled; non-convergence is reported, not thrown
UniformizeResult ricci_uniformize(const Vertices& vertices, const Triangles& triangles, const RicciOptions& options,
                                  ExecutionContext& context);

}  // namespace koebe
