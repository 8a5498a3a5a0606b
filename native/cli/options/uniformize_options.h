// The options of a map by the Koebe iteration: for one file or for many.
#pragma once

#include "cli/options/map_request.h"
#include "core/types.h"

#include <nlohmann/json.hpp>

namespace koebe::cli {

/// All of `koebe uniformize` in the table of options but for lists.
void add_uniformize_options(CLI::App& app, UniformizeOptions& options, bool& cut);

/// @throws CLI::ValidationError options that exclude each other, or are of another engine
void check_uniformize_options(const CLI::App& app, const UniformizeOptions& options, bool cut);

/// @throws CLI::ValidationError a centre, and a balance, which chooses one
void check_center(const UniformizeOptions& options);

/// What a map depends on beside the mesh, for its report.
nlohmann::ordered_json uniformize_report(const UniformizeOptions& options, bool cut);

/// For the value of --schedule.
/// @throws WrongUsage it does not fit the surface's loops; TopologyError as analyze_surface
void require_schedule_of_loops(const Triangles& triangles, Index vertex_count, const UniformizeOptions& options);

}  // namespace koebe::cli
