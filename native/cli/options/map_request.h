// What a sub-command that maps a surface to a circle domain is asked for: files, options.
#pragma once

#include "cli/files/output_files.h"
#include "io/mesh_writer.h"
#include "pipeline/options.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace koebe::cli {

struct MapRequest {
    std::string input, output, json, svg;
    std::string sphere;                         ///< of `koebe sphere` alone: the sphere as a mesh
    WrittenFormat format = WrittenFormat::obj;  ///< of OUT
    UniformizeOptions options;
    bool quiet = false;
    nlohmann::ordered_json entries = nlohmann::ordered_json::object();  ///< of the report, to set besides
};

/// IN and OUT. @param surface that IN may be @param coordinates that OUT has
void add_mesh_arguments(CLI::App& app, MapRequest& request, const std::string& surface = "surface with holes",
                        const std::string& coordinates = "texture coordinates in [0, 1]^2");
/// --json, --svg, --quiet. @param picture what is written for --svg
void add_report_options(CLI::App& app, MapRequest& request,
                        const std::string& picture = "write a picture of the circle domain there");
/// The files of a request, by the names that the usage has for them.
std::vector<OutputFile> map_files(const MapRequest& request);
/// @throws CLI::ValidationError OUT names no format; two of the files are one
void check_map_files(MapRequest& request);

}  // namespace koebe::cli
