// The Koebe iteration on a mesh with its holes filled by triangles: the reference engine, close to the paper.
#pragma once

#include "execution/execution.h"
#include "iteration/iteration_options.h"
#include "iteration/koebe_mesh_options.h"
#include "iteration/koebe_outcome.h"
#include "mesh/topology.h"
#include "surface/laplacian.h"

#include <vector>

namespace koebe {

/// @throws InputError as require_schedule; changing partners with a schedule or a method other than gk; the reflection
/// in the hole opened last with ck; the Yamabe flow with the first metric
void require_possible(const KoebeMeshOptions& mesh_options, int loop_count, Method method);

struct KoebeMeshResult {
    VectorXcd positions;   ///< (V) in the unit disk, the outer loop on the unit circle; 0 for unused vertices
    KoebeOutcome outcome;  ///< a history entry for each pair
};

/// Runs the iteration. S is the surface, D_k the disk of triangles that fills loop k.
///
/// Conventional (CK, section 1.2): fill all loops, loop 0 too. For k = 0..n, 0..n, ...: remove D_k and map the
/// remaining disk to the unit disk by Riemann's map (section 4.3), p the vertex deepest inside S. Its rim is loop k;
/// D_k lies outside, and the reflection tau brings it in. Against the outer loop (section 4.4, first algorithm), loop 0
/// is never filled: fill loops 1..n. For k = 1..n, 1..n, ...: remove D_k, map the remaining annulus, fill the image of
/// loop k, now a circle, harmonically (f_k). Generalized (GK, section 4.4, second algorithm), loop 0 filled too: for
/// the pairs (0,1), (2,3), ...: remove D_i and D_j, map the remaining annulus, fill both image circles; a reflection
/// tau brings in the outer one, whose disk lies outside.
///
/// The first D_k are fans around the means of the loops' vertices on the surface. A refilled disk is a flat Delaunay
/// mesh of the polygon of its image circle. The next refill takes the harmonic map of that mesh, unless it has become
/// too thin. With the first metric, automorphisms of the disk give a choice of polygons: the polygon with its conformal
/// barycentre at 0 is taken, which keeps its points spaced nearly as on the surface. With a planar metric the polygon
/// is the image itself. The two differ by O(h^2), anew in every step: with a planar metric the circles drift on and
/// never converge.
///
/// After each step the map takes S and D_1..D_n to the unit disk. It is harmonic, with loop 0 where the last step that
/// opened it has put it. Circles are fitted to the map by least squares. The iteration stops when (sum |c' - c|^2 +
/// r' - r|^2)^(1/2) falls under the tolerance over a sweep, with changing partners over a round of sweeps. It stops
/// without converging if ten rounds have not lowered this number.
///
/// With one loop the result is disk_map's up to an automorphism, with two loops that of a single step.
///
/// @param triangles, lengths the surface's faces and metric; two vertices must determine an edge, so an intrinsic
/// triangulation with flipped edges is not allowed in general
/// @param loops boundary loops, the surface on the left, the outer one first
/// @throws InputError as require_possible; SolverError, Cancelled
KoebeMeshResult koebe_mesh(const Vertices& vertices, const Triangles& triangles, const EdgeLengths& lengths,
                           const std::vector<VertexLoop>& loops, const IterationOptions& options,
                           ExecutionContext& context, const KoebeMeshOptions& mesh_options = {});

/// Runs the iteration on the surface's own faces and metric.
KoebeMeshResult koebe_mesh(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                           const IterationOptions& options, ExecutionContext& context,
                           const KoebeMeshOptions& mesh_options = {});

}  // namespace koebe
