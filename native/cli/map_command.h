// What the sub-commands that map a surface to a circle domain share: files, options, the result line.
#pragma once

#include "core/execution.h"
#include "io/mesh_writer.h"
#include "pipeline/result.h"
#include "report/json.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace koebe::cli {

struct MapRequest {
    std::string input, output, json, svg, outer = "auto";
    WrittenFormat format = WrittenFormat::obj;  ///< of OUT
    UniformizeOptions options;
    bool quiet = false;
    std::vector<std::pair<std::string, std::string>> names;  ///< entries of the report to set besides
};

/// IN and OUT.
void add_mesh_arguments(CLI::App& app, MapRequest& request);
/// --outer, --center, --point, --tolerance, --max-sweeps, --json, --svg, --threads, --quiet.
void add_map_options(CLI::App& app, MapRequest& request);
/// Sets what the options' words mean.
/// @throws CLI::ValidationError OUT names no format; two of the files are one
void check_map_options(MapRequest& request);

using MapFunction = std::function<UniformizeResult(const Vertices&, const Triangles&, ExecutionContext&)>;

/// Reads, computes, writes all files or none, and prints the result line.
/// @return an ExitCode
int run_map(const MapRequest& request, const MapFunction& compute);

}  // namespace koebe::cli
