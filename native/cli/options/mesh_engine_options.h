// Options of the mesh engine alone: the paper's own choices.
#pragma once

#include "core/types.h"
#include "pipeline/options.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace koebe::cli {

struct MeshEngineWords {
    std::string partners = "fixed", metric = "first", annulus = "harmonic";
    std::vector<std::string> schedule;  ///< "0-2": loops 0 and 2; "3": loop 3 alone
};

/// --partners, --schedule, --metric, --annulus.
void add_mesh_engine_options(CLI::App& app, MeshEngineWords& words);

/// Sets what the words mean.
/// @param options its engine and method set
/// @throws CLI::ValidationError options that exclude each other, or another engine
void set_mesh_engine_options(const CLI::App& app, const MeshEngineWords& words, UniformizeOptions& options);

/// For the value of --schedule.
/// @throws WrongUsage it does not fit the surface's loops; TopologyError as analyze_surface
void require_schedule_of_loops(const Triangles& triangles, Index vertex_count, const UniformizeOptions& options);

}  // namespace koebe::cli
