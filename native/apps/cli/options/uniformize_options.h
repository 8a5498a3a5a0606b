// The options of a map by the Koebe iteration, for one file or many.
#pragma once

#include "cli/options/map_request.h"
#include "core/types.h"

#include <nlohmann/json.hpp>

namespace koebe::cli {

/// Adds all options of `koebe uniformize` in the table, except lists.
void add_uniformize_options(CLI::App& app, UniformizeOptions& options, bool& cut);

/// @throws CLI::ValidationError options that exclude each other, or belong to another engine
void check_uniformize_options(const CLI::App& app, const UniformizeOptions& options, bool cut);

/// @throws CLI::ValidationError a centre together with a balance, which chooses the centre itself
void check_center(const UniformizeOptions& options);

/// The settings that a map depends on beside the mesh, for its report.
nlohmann::ordered_json uniformize_report(const UniformizeOptions& options, bool cut);

/// Checks the value of --schedule.
/// @throws WrongUsage it does not fit the surface's loops; TopologyError as analyze_surface
void require_schedule_of_loops(const Triangles& triangles, Index vertex_count, const UniformizeOptions& options);

}  // namespace koebe::cli
