// The options that every command has which computes a map.
#pragma once

#include "pipeline/options.h"

#include <CLI/CLI.hpp>

namespace koebe::cli {

/// --most-lost.
void add_most_lost(CLI::App& app, double& most_lost);

/// --tolerance, --max-sweeps, --threads.
void add_mapping_options(CLI::App& app, UniformizeOptions& options);

}  // namespace koebe::cli
