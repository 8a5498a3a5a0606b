// Where the Koebe iteration puts the loops of a surface, on more triangles where its own are too coarse.
#pragma once

#include "execution/execution.h"
#include "iteration/iteration_options.h"
#include "iteration/koebe_outcome.h"
#include "linear/boundary_solver.h"
#include "pipeline/map_input.h"
#include "surface/intrinsic_metric.h"

#include <memory>
#include <optional>
#include <vector>

namespace koebe {

/// What is assembled once for a surface, in two steps; once more where its vertices have moved.
struct AssembledInput {
    IntrinsicMetric metric;
    SparseMatrix laplacian;                    ///< cotan weights of the metric
    int uses = 0;                              ///< metrics that there were on its triangles, up to two
    std::optional<LaplacianPlaces> places;     ///< of these triangles, from the third metric on them
    std::unique_ptr<BoundarySolver> boundary;  ///< its factor
    bool factored = false;                     ///< whether that is of this Laplacian

    bool moved = false;  ///< whether move_metric has done what take_metric would

    void take_metric(const MapInput& input);
    /// The same of a surface with its vertices elsewhere, on the triangles of the last metric, so that its factor can
    /// be renewed. @return false where these are far from Delaunay
    bool move_metric(const MapInput& input);
    /// @throws SolverError
    void factorize(const MapInput& input, const IterationOptions& options);
    /// Of the same surface with its loops in another order: the factor is kept where that can be.
    void reorder(const MapInput& input);

private:
    void take_laplacian(const EdgeLengths& halves, const MapInput& input);
};

/// Runs the engine that the options name. Where the loops' images cannot be right (a circle that leaves the disk or
/// meets another, a boundary vertex without flux, more boundary vertices than inner ones) it runs again on a refined
/// surface (refined_input), up to three times, as long as that has at most 20,000 faces. The mesh engine, which is
/// slow, does so for unsound images alone, up to 4,000 faces.
/// @param assembled without a factor if the surface's matrix is singular
/// @param last of the same surface with its vertices elsewhere, if there is one (koebe_condensed)
/// @return the images of the surface's own loop vertices; no loops if nothing came of it
KoebeOutcome loop_images(const MapInput& input, const AssembledInput& assembled, const UniformizeOptions& options,
                         ExecutionContext& context, const KoebeOutcome* last = nullptr);

}  // namespace koebe
