// What the sub-commands that map a surface to a circle domain share: files, options, the result line.
#pragma once

#include "core/execution.h"
#include "io/mesh_writer.h"
#include "pipeline/result.h"
#include "report/json.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <string>

namespace koebe::cli {

struct MapRequest {
    std::string input, output, json, svg;
    std::string sphere;                         ///< of `koebe sphere` alone: the sphere as a mesh
    WrittenFormat format = WrittenFormat::obj;  ///< of OUT
    UniformizeOptions options;
    bool quiet = false;
    nlohmann::ordered_json entries = nlohmann::ordered_json::object();  ///< of the report, to set besides
};

/// IN and OUT.
void add_mesh_arguments(CLI::App& app, MapRequest& request);
/// --json, --svg, --quiet.
void add_report_options(CLI::App& app, MapRequest& request);
/// @throws CLI::ValidationError OUT names no format; two of the files are one
void check_map_files(MapRequest& request);

using MapFunction = std::function<UniformizeResult(const Vertices&, const Triangles&, ExecutionContext&)>;

/// Reads, computes, writes all files or none, and prints the result line.
/// @return an ExitCode
int run_map(const MapRequest& request, const MapFunction& compute);

}  // namespace koebe::cli
