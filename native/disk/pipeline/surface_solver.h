// Maps a surface again and again while its vertices move: an animation, a sculpting stroke, scans of one topology.
#pragma once

#include "core/api.h"
#include "execution/execution.h"
#include "pipeline/result.h"

#include <memory>

namespace koebe {

/// Maps a surface again and again. Topology, the order of elimination and the outer loop are found once. The iteration
/// starts at angles forecast from the last maps. It ends when the next sweep, by the contraction seen so far on this
/// surface, would move the circles by less than a third of the tolerance.
///
/// Up to an automorphism of the disk a map has the same circles as uniformize gives for the same positions and outer
/// loop. They agree to rounding where the surface was prepared anew (move_problem), else up to the mesh's resolution,
/// as the last triangulation is nearly Delaunay. The freedom that the options leave is used to lay the loops over those
/// of the first map that converged. An error or a cancel loses only the kept data: the next map then takes as long as a
/// first one.
class KOEBE_API SurfaceSolver {
public:
    /// @param vertices (V, 3) the first positions; they choose an outer loop that is automatic or the longest
    /// @param triangles (F, 3)
    /// @param options of the condensed engine; vertex_names and face_names must be empty
    /// @throws InputError, TopologyError, OutOfMemory
    SurfaceSolver(const Vertices& vertices, const Triangles& triangles, const UniformizeOptions& options = {});
    ~SurfaceSolver();
    SurfaceSolver(SurfaceSolver&&) noexcept;
    SurfaceSolver& operator=(SurfaceSolver&&) noexcept;

    /// Maps the surface with its vertices at new positions. One call at a time.
    /// @param vertices (V, 3), as many as before
    /// @throws InputError, SolverError, Cancelled, OutOfMemory; non-convergence is reported, not thrown
    UniformizeResult uniformize(const Vertices& vertices, ExecutionContext& context);
    UniformizeResult uniformize(const Vertices& vertices);

    Index vertex_count() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace koebe
