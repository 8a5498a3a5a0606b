// Computes the images of a surface's loops by the Koebe iteration, on a refined mesh where its own is too coarse.
#pragma once

#include "execution/execution.h"
#include "iteration/koebe_condensed.h"
#include "pipeline/map_input.h"
#include "surface/intrinsic_metric.h"

#include <optional>

namespace koebe {

/// The matrices of a surface, assembled in two steps, and again when its vertices have moved.
struct AssembledInput {
    bool moves = false;                     ///< whether the metric is kept for move_metric
    IntrinsicMetric metric;                 ///< empty if it is not kept
    VectorXd areas;                         ///< of the metric, of each vertex
    SparseMatrix laplacian;                 ///< curvature_weights of the metric
    int uses = 0;                           ///< metrics so far on its triangles, counted up to two
    std::optional<LaplacianPlaces> places;  ///< of these triangles, from the third metric on them
    FactoredSurface boundary;               ///< the Laplacian's factor
    bool factored = false;                  ///< whether the factor is of the present Laplacian

    bool moved = false;  ///< whether move_metric has replaced take_metric

    void take_metric(const MapInput& input);
    /// Takes the metric of the surface with moved vertices on the triangles of the last metric, so that the factor can
    /// be renewed. @return false where these triangles are far from Delaunay
    bool move_metric(const MapInput& input);
    /// @throws SolverError
    void factorize(const MapInput& input, const IterationOptions& options);
    /// Takes the loops of the surface in another order. Keeps the factor where possible.
    void reorder(const MapInput& input);

private:
    void take_laplacian(const EdgeLengths& halves, const MapInput& input);
};

/// Runs the engine that the options name. Runs it again on a refined surface (refined_input) where the loops' images
/// cannot be right: a circle leaves the disk or meets another, a boundary vertex has no flux, or there are more
/// boundary vertices than inner ones. Refines up to three times, to at most 20,000 faces. The slow mesh engine refines
/// for unsound images alone, up to 4,000 faces.
/// @param assembled without a factor if the surface's matrix is singular
/// @param last outcome for the same surface with other positions, if any (koebe_condensed)
/// @return the images of the surface's own loop vertices; no loops if the iteration failed
KoebeOutcome loop_images(const MapInput& input, const AssembledInput& assembled, const UniformizeOptions& options,
                         ExecutionContext& context, const KoebeOutcome* last = nullptr);

}  // namespace koebe
