// The Ricci flow as a rival of uniformize, with the same input and report.
#pragma once

#include "baselines/ricci_flow.h"
#include "execution/execution.h"
#include "pipeline/result.h"

namespace koebe {

struct RicciOptions {
    UniformizeOptions common;  ///< uses outer, center, point, tolerance, max_sweeps (updates of the target) and threads
    Packing packing = Packing::inversive;
    BoundaryTarget target = BoundaryTarget::inscribed;
    bool delaunay = true;  ///< flip the surface's edges to intrinsic Delaunay first, as in uniformize
};

/// Maps a surface with holes to a circle domain by the discrete Ricci flow (baselines/ricci_flow.h).
///
/// Before and after the flow it does the same as uniformize: cuts ears off and attaches them again, untangles flipped
/// faces, makes two loops concentric. Flips stay only where curvature remains. The flow's own map is neither put on
/// circles nor balanced. Method and engine of the result are the options' and mean nothing. Warnings say by how much
/// the packing has changed the metric, how many faces the flow's own map flips, and why it has not converged.
/// @throws InputError, TopologyError, SolverError, Cancelled; non-convergence is reported, not thrown
UniformizeResult ricci_uniformize(const Vertices& vertices, const Triangles& triangles, const RicciOptions& options,
                                  ExecutionContext& context);

}  // namespace koebe
