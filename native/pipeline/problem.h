// A surface on its way to a map, and what of it stays when its vertices move.
#pragma once

#include "execution/execution.h"
#include "flaps/flaps.h"
#include "iteration/angle_forecast.h"
#include "pipeline/loop_images.h"
#include "pipeline/map_from_loops.h"
#include "pipeline/map_input.h"
#include "pipeline/result.h"

#include <functional>
#include <optional>

namespace koebe {

/// The surface of a run, and what it is mapped with.
struct Problem {
    MapInput whole;
    FlapCut cut;
    std::optional<MapInput> core;  ///< without the flaps, if there are flaps
    AssembledInput assembled;      ///< of input()
    KoebeOutcome outcome;          ///< of the last run on it: where the next one begins
    AngleForecast forecast;        ///< of the runs on it: with which angles
    Index vertex_count = 0;        ///< of the input
    VectorXcd first_places;  ///< of the input's vertices: where lay_over_first is to bring them, NaN inside, or none

    const MapInput& input() const { return core ? *core : whole; }
    MapSolver solver() const { return {*assembled.boundary, assembled.laplacian, input()}; }
};

/// @throws InputError, TopologyError, OutOfMemory
Problem prepare_problem(const Vertices& vertices, const Triangles& triangles, const UniformizeOptions& options);

/// Whether the first map is to choose the outer loop: with Balance::area, unless something else does.
bool chooses_outer_loop(const UniformizeOptions& options, const MapInput& input);

/// The same surface with its vertices elsewhere. Topology, outer loop, triangulation and order of elimination stay, and
/// the angles of the last maps.
/// @param vertices (V, 3) as many as before
/// @return false, with nothing left of use, where the problem must be prepared anew to be the same as without a last
/// map: other flaps hang on it, its holes are in another order of length, its triangulation is far from Delaunay
/// @throws InputError
bool move_problem(Problem& problem, const Vertices& vertices);

/// What forecast is to know of the last run, if it converged.
void remember_angles(Problem& problem);

/// Where the last run took the vertices of the loops, as first_places.
VectorXcd places_of_loops(const Problem& problem);

/// Moves a map of the last run by the automorphism of the disk that brings its loops nearest to first_places, if there
/// are any: circles are fitted before that, so that they do not depend on it. The run's images of loops are the map's
/// then.
void lay_over_first(Problem& problem, CircleMap& map);

/// The map of a problem, and its report. @param vertices, triangles of the input, which the report is on
/// @param prepare makes the problem ready; its time counts as topology
UniformizeResult map_problem(const Vertices& vertices, const Triangles& triangles,
                             const std::function<Problem&()>& prepare, const UniformizeOptions& options,
                             ExecutionContext& context);

}  // namespace koebe
