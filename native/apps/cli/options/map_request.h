// The files and options of a sub-command that maps a surface to a circle domain.
#pragma once

#include "cli/files/output_files.h"
#include "cli/options/option_table.h"
#include "io/mesh_formats.h"
#include "io/mesh_writer.h"
#include "pipeline/options.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace koebe::cli {

/// Options of how files are read and written, of several commands.
struct FileOptions {
    std::optional<double> weld = {};  ///< distance of vertices that are joined in the map (io/welding.h)
    CutAt cut_at = CutAt::nothing;    ///< what in the file cuts the surface
    int uv_channel = 0;               ///< the set of UVs that is written, where a file has several
};

struct MapRequest {
    std::string input, output, json, svg;
    std::string sphere;                  ///< for `koebe sphere`: the sphere as a mesh
    const MeshFormat* format = nullptr;  ///< of OUT; null: GLB
    UniformizeOptions options;
    FileOptions of_files;
    bool quiet = false;
    nlohmann::ordered_json entries = nlohmann::ordered_json::object();  ///< additional entries of the report
};

/// Adds the argument of a mesh. @param surface description, before the formats; `more` after them
CLI::Option* add_input(CLI::App& app, std::string& path, const std::string& surface, const std::string& name = "IN",
                       const std::string& more = "");
/// Adds OUT.
void add_output(CLI::App& app, std::string& path, const std::string& description);
/// Adds OUT for the mapped mesh.
void add_mapped_mesh(CLI::App& app, MapRequest& request,
                     const std::string& coordinates = "texture coordinates in [0, 1]^2");
/// Adds IN and OUT. @param surface description of IN @param coordinates description of OUT's
void add_mesh_arguments(CLI::App& app, MapRequest& request, const std::string& surface = "surface with holes",
                        const std::string& coordinates = "texture coordinates in [0, 1]^2");
/// Adds --json, --svg, --quiet. @param picture description of --svg; empty: there is none
void add_report_options(CLI::App& app, MapRequest& request,
                        const std::string& picture = "write a picture of the circle domain there");
/// Notes the options of a map, and those of files, for the report.
template <typename Options>
void report_options(MapRequest& request, std::string_view map, const Options& options)
{
    request.entries["options"] = option_report(map, options);
    request.entries["options"].update(option_report(map, request.of_files));
}
/// The files of a request, with their names in the usage.
std::vector<OutputFile> map_files(const MapRequest& request);
/// @throws CLI::ValidationError OUT names no format; two of the files are the same
void check_map_files(MapRequest& request);

}  // namespace koebe::cli
