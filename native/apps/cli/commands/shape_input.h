// A mesh file mapped to its circle domain, for sub-commands that use only the circles.
#pragma once

#include "certified/polygonal_circles.h"
#include "cli/commands/subcommand.h"
#include "cli/options/map_request.h"
#include "execution/execution.h"
#include "pipeline/result.h"
#include "transfer/landmark_map.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace koebe::cli {

struct ShapeOptions {
    UniformizeOptions map;
    FileOptions of_files;
    RimKind rims = RimKind::smooth;
    bool with_error = false;  ///< also what error bars need: another map, of a finer mesh
};

struct ShapeInput {
    std::string name;                ///< of the file
    RimKind rims = RimKind::smooth;  ///< whose circles they are
    std::vector<Circle> circles;     ///< the outer one first, then by length
    std::vector<Circle> refined;     ///< for error bars: the same on a finer mesh (refined_circles) if requested, or of
                                     ///< upper bounds (PolygonalCircles)
    MappedSurface surface;           ///< the mesh and its map
    std::vector<Index> ranks;        ///< rank of each circle's loop, by lowest vertex as in `koebe fill`
    bool converged = false;
    std::vector<Warning> warnings;
};

/// @throws FileError, InputError, TopologyError, SolverError, Cancelled
/// With smooth rims a warning says where a forecast of polygonal ones (polygonal_changes) is another module.
ShapeInput read_shape(const std::string& path, const ShapeOptions& options, const CancelToken& token);

/// {"version", "input", "converged", "rims", "loops", "names", "module", "warnings"}: the module with the loops in this
/// order, and "errors" (module_error) if the shape has them.
nlohmann::ordered_json module_json(const ShapeInput& shape, const std::vector<int>& order);

}  // namespace koebe::cli
