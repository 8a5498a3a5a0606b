// Discrete Ricci flow to a flat metric whose boundary loops are circles: the paper's comparison (section 5).
#pragma once

#include "baselines/circle_packing.h"
#include "execution/execution.h"
#include "flow/convex_newton.h"
#include "iteration/koebe_outcome.h"
#include "surface/intrinsic_metric.h"

#include <string>
#include <vector>

namespace koebe {

/// How edges share a loop's curvature, 2 pi outside and -2 pi at a hole. A vertex gets half of its two edges' shares.
enum class BoundaryTarget {
    inscribed,     ///< by the edge's angle as a chord of the circle through the loop: holes close exactly
    proportional,  ///< by length: off by O(h^2), so holes do not close and circles drift on
};

struct RicciFlowOptions {
    Packing packing = Packing::inversive;
    BoundaryTarget target = BoundaryTarget::inscribed;
    double tolerance = 1e-6;  ///< on the circles' change from one target to the next, a length in the unit disk
    int max_updates = 50;     ///< of the target
    NewtonOptions newton;     ///< for each target
};

struct RicciFlowResult {
    VectorXcd positions;   ///< (V) in the unit disk, scaled and moved so that the outer circle is the unit circle
    KoebeOutcome outcome;  ///< a sweep and a history entry for each target; `steps` counts Newton's
    VectorXd target;       ///< (V) last target curvature, radians
    double packing_change = 0.0;   ///< largest relative change of an edge by the packing
    double curvature_error = 0.0;  ///< largest |curvature - target|, radians
    double closing_gap = 0.0;      ///< largest gap of a hole's edges, over the hole's length
    std::vector<Index> collapsed;  ///< faces whose lengths break the triangle inequality, where there is no map
    std::string reason;            ///< why it has not converged
};

/// Newton's method on the Ricci energy of a circle packing metric (Chow and Luo 2003; Jin, Kim, Luo, Gu 2008). Its
/// gradient in the logarithms of the radii is the curvature less the target, its Hessian a Laplacian with the power
/// centres' weights. The target is 0 inside. On the boundary it depends on the resulting lengths, and is updated until
/// the circles stand still. Changes of the target are damped to 2/3 at holes: along a round hole the first mode of a
/// change returns with the factor -1, on the outer loop with +1 (a Moebius map), higher modes with -1/k and 1/k. The
/// metric is unfolded, and positions are fitted to the edges.
///
/// @param metric a surface of genus 0 with strict triangle inequalities. The flow flips no edge, so needles collapse;
/// an intrinsic Delaunay triangulation has fewer
/// @param loops the outer one first, surface on the left
/// @throws Cancelled; non-convergence is reported
RicciFlowResult ricci_flow(const IntrinsicMetric& metric, Index vertex_count, const std::vector<VertexLoop>& loops,
                           const RicciFlowOptions& options, ExecutionContext& context);

/// The Ricci energy.
class RicciEnergy : public ConvexEnergy {
public:
    RicciEnergy(const Triangles& triangles, CirclePacking packing, std::vector<char> boundary);

    void set_target(const VectorXd& target) { target_ = target; }
    VectorXd gradient(const VectorXd& log_radii) override;
    SparseMatrix hessian() const override;
    const EdgeLengths& lengths() const { return lengths_; }  ///< at the point of the last gradient

private:
    const Triangles& triangles_;
    CirclePacking packing_;
    std::vector<char> boundary_;
    VectorXd target_, log_radii_;
    EdgeLengths lengths_;
};

/// (m) turning angle at each vertex of a polygon with the given edges (edge b from vertex b to the next), sum 2 pi.
/// Inscribed: half the central angles of the vertex's two edges. If an edge is longer than all others together: by
/// length.
VectorXd turning_angles(const VectorXd& edges, BoundaryTarget target);

}  // namespace koebe
