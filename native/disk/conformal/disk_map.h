// The Riemann map of a topological disk (paper, section 4.3).
#pragma once

#include "conformal/annulus_map.h"
#include "core/api.h"
#include "core/types.h"
#include "surface/laplacian.h"

namespace koebe {

struct DiskMapOptions {
    /// Inner vertex p to put at the origin; -1: the deepest inner vertex, the maximum of the torsion function.
    Index center = -1;
    /// The removed disk D_n is the star of p, shrunk by 2^-n.
    int halvings = 3;
    /// A vertex outside the closed disk is an error; false: the caller needs only the loop.
    bool inside = true;
    AnnulusBackend backend = AnnulusBackend::harmonic;  ///< of the annulus that the surface without D_n is mapped to
};

struct DiskMap {
    VectorXcd positions;       ///< (V) in the unit disk, the loop on the unit circle, p at 0; 0 for unused vertices
    Index center = -1;         ///< for the annulus map of the surface without D_n
    double hole_radius = 0.0;  ///< of the annulus map of the surface without D_n: 0 in the limit
};

/// Riemann's map as the limit of annulus maps: remove a small disk D_n around p, map the rest to an annulus, and let
/// D_n shrink to p.
///
/// On the mesh D_n is the star of p shrunk by 2^-n; the ring between is cut into n layers of similar quadrilaterals.
/// Away from p the map of S \ D_n differs from the limit by O(|D_n|^2), and by a disk automorphism of O(|D_n|) if D_n
/// is not centred. So only its boundary values are kept. The harmonic map of S with these values fills D_n again, and
/// an automorphism puts p at the origin.
///
/// @param triangles (F, 3) oriented, one boundary loop
/// @param lengths (F, 3) edge lengths
/// @param loop the boundary, surface on the left
/// @throws InputError the centre is not an inner vertex; SolverError, also for a map that leaves the closed disk, or a
/// Yamabe flow that does not converge
KOEBE_API DiskMap disk_map(const Triangles& triangles, const EdgeLengths& lengths, Index vertex_count,
                           const VertexLoop& loop, const DiskMapOptions& options = {});

}  // namespace koebe
