// The run of all sub-commands that map a surface to a circle domain.
#pragma once

#include "cli/options/map_request.h"
#include "execution/execution.h"
#include "pipeline/result.h"

#include <functional>

namespace koebe::cli {

using MapFunction =
    std::function<UniformizeResult(const Vertices&, const Triangles&, const UniformizeOptions&, ExecutionContext&)>;

/// Reads, computes, writes all files or none, and prints the result line.
/// @return an ExitCode
int run_map(const MapRequest& request, const MapFunction& compute);

}  // namespace koebe::cli
