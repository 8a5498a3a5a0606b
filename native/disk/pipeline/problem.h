// A surface being mapped, and the data that stays when its vertices move.
#pragma once

#include "ears/ears.h"
#include "execution/execution.h"
#include "iteration/angle_forecast.h"
#include "pipeline/loop_images.h"
#include "pipeline/map_from_loops.h"
#include "pipeline/map_input.h"
#include "pipeline/result.h"

#include <functional>
#include <optional>

namespace koebe {

/// The surface of a run, its matrices and the last outcome.
struct Problem {
    MapInput whole;
    EarCut cut;
    std::optional<MapInput> core;  ///< without the ears, if there are ears
    AssembledInput assembled;      ///< of input()
    KoebeOutcome outcome;          ///< of the last run; the next one starts from it
    AngleForecast forecast;        ///< of the first angles, from the last runs
    Index vertex_count = 0;        ///< of the input
    VectorXcd first_places;        ///< where align_with_first is to bring the input's vertices, NaN inside; or empty

    const MapInput& input() const { return core ? *core : whole; }
    MapSolver solver() const { return {assembled.boundary.solver(), assembled.laplacian, input()}; }
};

/// @throws InputError, TopologyError, OutOfMemory
Problem prepare_problem(const Vertices& vertices, const Triangles& triangles, const UniformizeOptions& options);

/// Whether the first map chooses the outer loop: with Balance::area, unless the options choose it.
bool chooses_outer_loop(const UniformizeOptions& options, const MapInput& input);

/// Moves the vertices of the surface. Topology, outer loop, triangulation, order of elimination and the angles of the
/// last maps stay.
/// @param vertices (V, 3) as many as before
/// @return false if the problem must be prepared anew to give the same map as a new problem: other ears, another order
/// of the holes' lengths, or a triangulation far from Delaunay. Then the problem is unusable
/// @throws InputError
bool move_problem(Problem& problem, const Vertices& vertices);

/// Adds the last run's angles to the forecast, if it converged.
void remember_angles(Problem& problem);

/// The places of the loops' vertices in the last run, as first_places.
VectorXcd places_of_loops(const Problem& problem);

/// Moves a map of the last run by the automorphism of the disk that brings its loops nearest to first_places, if there
/// are any. Circles are fitted before, so they do not depend on it. Afterwards the run's images of loops are the map's.
void align_with_first(Problem& problem, CircleMap& map);

/// Maps the problem and reports on the map. @param vertices, triangles of the input, for the report
/// @param prepare prepares the problem; its time counts as topology
UniformizeResult map_problem(const Vertices& vertices, const Triangles& triangles,
                             const std::function<Problem&()>& prepare, const UniformizeOptions& options,
                             ExecutionContext& context);

}  // namespace koebe
