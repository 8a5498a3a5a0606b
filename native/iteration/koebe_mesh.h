// The Koebe iteration on a mesh whose holes are filled by triangles: the reference engine, beside the paper.
#pragma once

#include "execution/execution.h"
#include "iteration/iteration_options.h"
#include "iteration/koebe_mesh_options.h"
#include "iteration/koebe_outcome.h"
#include "mesh/topology.h"
#include "surface/laplacian.h"

#include <vector>

namespace koebe {

/// @throws InputError as require_schedule; changing partners with another method than gk or a schedule; the Yamabe flow
///         with the first metric
void require_possible(const KoebeMeshOptions& mesh_options, int loop_count, Method method);

struct KoebeMeshResult {
    VectorXcd positions;   ///< (V) in the unit disk, the outer loop on the unit circle; 0 for unused vertices
    KoebeOutcome outcome;  ///< a history entry for each pair
};

/// Runs the iteration. S is the surface, D_k the disk of triangles that fills loop k.
///
/// Conventional (CK, section 1.2): fill all loops, loop 0 too; for k = 0..n, 0..n, ...: remove D_k, map the disk that
/// is left by Riemann's map (section 4.3), p the vertex deepest inside S, to the unit disk. Loop k is now its rim; D_k
/// lies outside and is brought in by the reflection tau. Against the outer loop (section 4.4, first algorithm), loop 0
/// never filled: fill loops 1..n; for k = 1..n, 1..n, ...: remove D_k, map the annulus that is left, fill the image of
/// loop k, now a circle, harmonically (f_k). Generalized (GK, section 4.4, second algorithm), loop 0 filled too: for
/// the pairs (0,1), (2,3), ...: remove D_i and D_j, map the annulus that is left, fill both image circles; the outer
/// one, whose disk lies outside, is brought in by a reflection tau.
///
/// The first D_k are fans around the means of the loops' vertices on the surface. A disk that has been refilled is a
/// flat Delaunay mesh of the polygon of its image circle; the next refill takes the harmonic map of that mesh, unless
/// it has become too thin. With the first metric that polygon is one of many that differ by an automorphism of the
/// disk: the one with the conformal barycentre at 0 is taken, which keeps the spacing of its points near that on the
/// surface. With a planar one it is the image itself. The two differ by O(h^2), anew in every step, so that with a
/// planar metric the circles drift on for ever instead of converging.
///
/// After each step the map is S and D_1..D_n on the unit disk, harmonic with loop 0 where the last step that opened
/// it has put it. Circles are fitted to it by least squares; the iteration stops when (sum |c' - c|^2 +
/// |r' - r|^2)^(1/2) falls under the tolerance over a sweep, with changing partners over a round of sweeps.
///
/// With one loop it is disk_map's result up to an automorphism, with two that of the one step there is.
///
/// @param triangles, lengths the surface's faces and metric; an edge must be told by its two ends, so an intrinsic
///        triangulation with flipped edges will not do in general
/// @param loops boundary loops, the surface on the left, the outer one first
/// @throws InputError as require_possible; SolverError, Cancelled
KoebeMeshResult koebe_mesh(const Vertices& vertices, const Triangles& triangles, const EdgeLengths& lengths,
                           const std::vector<VertexLoop>& loops, const IterationOptions& options,
                           ExecutionContext& context, const KoebeMeshOptions& mesh_options = {});

/// The same for the surface's own faces and metric.
KoebeMeshResult koebe_mesh(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                           const IterationOptions& options, ExecutionContext& context,
                           const KoebeMeshOptions& mesh_options = {});

}  // namespace koebe
