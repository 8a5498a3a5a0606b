// Many maps of one surface whose vertices move: an animation, a sculpting stroke, scans of one topology.
#pragma once

#include "core/api.h"
#include "execution/execution.h"
#include "pipeline/result.h"

#include <memory>

namespace koebe {

/// A surface that is mapped again and again. Its topology, the order of elimination and the outer loop are found once;
/// the iteration begins at the angles that the last maps forecast, and ends when the next sweep, by the contraction
/// that was seen on this surface, would move the circles by less than a third of the tolerance.
///
/// Up to an automorphism of the disk a map's circles are those that uniformize gives for the same positions and outer
/// loop: to rounding where the surface had to be prepared anew (move_problem), else up to what the mesh resolves, as
/// the last triangulation is nearly Delaunay. Of the freedom that the options leave, as much as there is goes into
/// laying the loops over those of the first map that converged. After an error or a cancel nothing is lost but what was
/// kept: the next map takes as long as a first one.
class KOEBE_API SurfaceSolver {
public:
    /// @param vertices (V, 3) the first positions: with an outer loop that is automatic or the longest, they choose it
    /// @param triangles (F, 3)
    /// @param options of the condensed engine; vertex_names and face_names must be empty
    /// @throws InputError, TopologyError, OutOfMemory
    SurfaceSolver(const Vertices& vertices, const Triangles& triangles, const UniformizeOptions& options = {});
    ~SurfaceSolver();
    SurfaceSolver(SurfaceSolver&&) noexcept;
    SurfaceSolver& operator=(SurfaceSolver&&) noexcept;

    /// The map with the vertices elsewhere. One call at a time.
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
