#include "cli/options/map_request.h"

#include "files/extension.h"

#include <string>
#include <vector>

namespace koebe::cli {
namespace {

/// Requires files that a map of a GLB file can have.
void require_glb_files(const MapRequest& request)
{
    if (io::lower_extension(request.input) != glb_extension)
        throw CLI::ValidationError("OUT", "only a GLB file is written as GLB: IN must end in .glb, too");
    if (!request.sphere.empty())
        throw CLI::ValidationError("--sphere",
                                   "needs an OUT that ends in " + io::listed_formats(io::FormatName::extension, true));
}

}  // namespace

CLI::Option* add_input(CLI::App& app, std::string& path, const std::string& surface, const std::string& name,
                       const std::string& more)
{
    return app.add_option(name, path, surface + ": " + io::listed_formats(io::FormatName::word) + more)->required();
}

void add_output(CLI::App& app, std::string& path, const std::string& description)
{
    app.add_option("OUT", path, description)->required();
}

void add_mapped_mesh(CLI::App& app, MapRequest& request, const std::string& coordinates)
{
    add_output(app, request.output,
               io::listed_formats(io::FormatName::word, true) +
                   " to write (GLB from GLB): the same vertices and faces, with " + coordinates);
}

void add_mesh_arguments(CLI::App& app, MapRequest& request, const std::string& surface, const std::string& coordinates)
{
    add_input(app, request.input, surface);
    add_mapped_mesh(app, request, coordinates);
}

void add_report_options(CLI::App& app, MapRequest& request, const std::string& picture)
{
    app.add_option("--json", request.json, "write the report there")->type_name("FILE");
    if (!picture.empty()) app.add_option("--svg", request.svg, picture)->type_name("FILE");
    app.add_flag("--quiet", request.quiet, "no progress and no result line");
}

std::vector<OutputFile> map_files(const MapRequest& request)
{
    return {{"OUT", request.output}, {"--sphere", request.sphere}, {"--json", request.json}, {"--svg", request.svg}};
}

void check_map_files(MapRequest& request)
{
    if (io::lower_extension(request.output) == glb_extension)
        require_glb_files(request);
    else
        request.format = required_format(request.output);
    if (request.of_files.uv_channel > 0 && io::lower_extension(request.output) != glb_extension)
        throw CLI::ValidationError("--uv-channel", "only GLB files have a second set of texture coordinates");
    require_different_files(map_files(request), {request.input}, !request.quiet);
}

}  // namespace koebe::cli
