// A mesh file mapped to its circle domain, for sub-commands that use only the circles.
#pragma once

#include "cli/commands/subcommand.h"
#include "execution/execution.h"
#include "pipeline/result.h"
#include "transfer/landmark_map.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace koebe::cli {

struct ShapeInput {
    std::string name;             ///< of the file
    std::vector<Circle> circles;  ///< the outer one first, then by length
    std::vector<Circle> refined;  ///< circles of the same loops on a finer mesh (refined_circles), if requested
    MappedSurface surface;        ///< the mesh and its map
    std::vector<Index> ranks;     ///< rank of each circle's loop, by lowest vertex as in `koebe fill`
    bool converged = false;
    std::vector<Warning> warnings;
};

/// @throws FileError, InputError, TopologyError, SolverError, Cancelled
ShapeInput read_shape(const std::string& path, const UniformizeOptions& options, const CancelToken& token,
                      bool with_refined = false);

/// {"version", "input", "converged", "loops", "names", "module", "warnings"}: the module with the loops in this order.
nlohmann::ordered_json module_json(const ShapeInput& shape, const std::vector<int>& order);

}  // namespace koebe::cli
