// The conformal map of a topological annulus to a round one (paper, section 4.2).
#pragma once

#include "core/api.h"
#include "core/types.h"
#include "surface/laplacian.h"
#include "surface/one_form.h"

#include <vector>

namespace koebe {

enum class AnnulusBackend { harmonic, yamabe };  ///< a holomorphic 1-form, or the flat cylinder's metric

struct AnnulusMapOptions {
    AnnulusBackend backend = AnnulusBackend::harmonic;
    bool flips = true;   ///< of edges in the Yamabe flow (flow/yamabe_flow.h)
    bool inside = true;  ///< a vertex outside the closed disk is an error; false: the caller needs only the loops
};

/// The map and every step of its construction.
struct AnnulusMap {
    VectorXcd positions;        ///< (V) |z| = 1 on the outer loop, |z| = inner_radius on the inner one; 0 if unused
    double inner_radius = 0.0;  ///< exp(-2 pi / lambda)

    std::vector<Index> cut;  ///< half-edges of the shortest edge path from the outer to the inner loop, in order
    VectorXd f;              ///< (V) harmonic, 0 on the outer loop, 1 on the inner
    VectorXd g0;             ///< (3F) per corner: 1 at the path's vertices seen from its right side, else 0
    VectorXd g1;             ///< (V) makes dg0 + dg1 harmonic, without flow through the loops
    double lambda = 0.0;     ///< omega = df + i lambda (dg0 + dg1) is holomorphic

    // The Yamabe backend leaves the cut, f, g0 and g1 empty.
    bool converged = true;         ///< false: curvature remains, or faces have collapsed; positions are not a map
    int steps = 0;                 ///< Newton steps
    double curvature_error = 0.0;  ///< largest curvature that remains at a vertex, radians
    Index collapsed = 0;           ///< faces whose lengths on the cylinder break the triangle inequality
};

/// Maps a topological annulus conformally onto r < |z| < 1 by the holomorphic 1-form omega = df + i lambda (dg0 + dg1).
///
/// f is harmonic between the loops; g0 lives on the mesh sliced along the cut path and jumps by 1 across it, so
/// dg0 is closed with period 1; dg1 makes it harmonic. The Hodge star turns df into lambda (dg0 + dg1), where
/// |dg|^-2 <= lambda <= |df|^2 (the two are the conjugate extremal estimates of 2 pi / log(1/r)); lambda = |df| / |dg|
/// minimizes energy over area of f + i lambda g. The integral of omega on the sliced mesh is f + i lambda (g0 + g1),
/// with period k = -lambda around the outer loop, and z = exp(2 pi / k (f + i lambda g)).
///
/// The Yamabe backend (paper, abstract) finds the conformally equivalent metric without curvature inside and along both
/// loops. It is a flat cylinder of girth L and height H, laid out as w in the strip; z = exp(2 pi i w / L) and r =
/// exp(-2 pi H / L). The two backends agree to the order of the discretization.
///
/// @param triangles (F, 3) oriented, exactly two boundary loops
/// @param lengths (F, 3) edge lengths in any unit, which may differ between parts that are conformally flat
/// @param outer, inner the boundary loops, surface on the left
/// @return orientation kept: the outer loop runs counter-clockwise. At 1 is the first vertex of the cut, or of the
/// outer loop with the Yamabe backend. The Yamabe backend reports if it does not converge
/// @throws TopologyError the loops are not connected; SolverError, also for a map that leaves the closed disk
KOEBE_API AnnulusMap annulus_map(const Triangles& triangles, const EdgeLengths& lengths, Index vertex_count,
                                 const VertexLoop& outer, const VertexLoop& inner,
                                 const AnnulusMapOptions& options = {});

}  // namespace koebe
