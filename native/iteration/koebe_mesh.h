// The Koebe iteration on a mesh whose holes are filled by triangles: the reference engine, beside the paper.
#pragma once

#include "core/execution.h"
#include "core/topology.h"
#include "iteration/disk_patch.h"
#include "iteration/koebe_outcome.h"
#include "surface/laplacian.h"

#include <vector>

namespace koebe {

struct KoebeMeshOptions {
    /// Which Laplacian a step takes for the surface: that of its first metric, or that of its present planar image,
    /// which the paper writes. The two differ by O(h^2), anew in every step, so that with the second the circles
    /// drift on for ever instead of converging.
    enum class Metric { first, present };
    Metric metric = Metric::first;
    DiskPatchOptions patch;
};

struct KoebeMeshResult {
    VectorXcd positions;   ///< (V) in the unit disk, the outer loop on the unit circle; 0 for unused vertices
    KoebeOutcome outcome;  ///< a history entry for each pair
};

/// Runs the iteration (paper, section 4.4). S is the surface, D_k the disk of triangles that fills loop k.
///
/// Conventional (CK), loop 0 never filled: fill loops 1..n; for k = 1..n, 1..n, ...: remove D_k, map the annulus
/// that is left, fill the image of loop k, now a circle, harmonically (f_k).
/// Generalized (GK), loop 0 filled too: for the pairs (0,1), (2,3), ...: remove D_i and D_j, map the annulus that is
/// left, fill both image circles; the outer one, whose disk lies outside, is brought in by a reflection tau.
///
/// The first D_k are fans around the mass centres on the surface. A disk that has been refilled is a flat Delaunay
/// mesh of the polygon of its image circle; the next refill takes the harmonic map of that mesh, unless it has become
/// too thin. The polygon is one of many that differ by an automorphism of the disk: the one with the conformal
/// barycentre at 0 is taken, which keeps the spacing of its points near that on the surface.
///
/// After each step the map is S and D_1..D_n on the unit disk, harmonic with loop 0 where the last step that opened
/// it has put it. Circles are fitted to it as in section 5; the iteration stops when (sum |c' - c|^2 +
/// |r' - r|^2)^(1/2) falls under the tolerance over a sweep.
///
/// With one loop it is disk_map's result up to an automorphism, with two that of the one step there is.
///
/// @param triangles, lengths the surface's faces and metric; an edge must be told by its two ends, so an intrinsic
///        triangulation with flipped edges will not do in general
/// @param loops boundary loops, the surface on the left, the outer one first
/// @throws SolverError, Cancelled
KoebeMeshResult koebe_mesh(const Vertices& vertices, const Triangles& triangles, const EdgeLengths& lengths,
                           const std::vector<VertexLoop>& loops, const IterationOptions& options,
                           ExecutionContext& context, const KoebeMeshOptions& mesh_options = {});

/// The same for the surface's own faces and metric.
KoebeMeshResult koebe_mesh(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                           const IterationOptions& options, ExecutionContext& context,
                           const KoebeMeshOptions& mesh_options = {});

}  // namespace koebe
