#include "cli/options/map_request.h"

#include "cli/options/mapping_options.h"
#include "cli/options/validators.h"

#include <string>
#include <vector>

namespace koebe::cli {

void add_mesh_arguments(CLI::App& app, MapRequest& request)
{
    app.add_option("IN", request.input, "surface with holes: OBJ, OFF, PLY or STL")->required();
    app.add_option("OUT", request.output,
                   "OBJ or PLY to write: the same vertices and faces, with texture coordinates in [0, 1]^2")
        ->required();
}

void add_domain_options(CLI::App& app, MapRequest& request)
{
    UniformizeOptions& options = request.options;
    app.add_option("--outer", request.outer, "loop for the unit circle: auto, longest, or that of a vertex (from 0)")
        ->check(outer_loop_choice({"auto", "longest"}))
        ->type_name("auto|longest|VERTEX")
        ->capture_default_str();
    add_mapping_options(app, options);
    add_most_lost(app, options.most_lost);
    app.add_option("--center", options.center, "vertex inside the surface that goes to 0 (from 0)")
        ->check(whole_number(0))
        ->type_name("VERTEX");
    app.add_option("--point", options.point,
                   "vertex of a boundary loop that goes to 1, and its loop to the unit circle")
        ->check(whole_number(0))
        ->type_name("VERTEX");
}

void add_report_options(CLI::App& app, MapRequest& request)
{
    app.add_option("--json", request.json, "write the report there")->type_name("FILE");
    app.add_option("--svg", request.svg, "write a picture of the circle domain there")->type_name("FILE");
    app.add_flag("--quiet", request.quiet, "no progress and no result line");
}

void set_outer_loop(MapRequest& request)
{
    UniformizeOptions& options = request.options;
    if (request.outer == "auto") {
        options.outer = OuterLoop::automatic;
    } else if (request.outer == "longest") {
        options.outer = OuterLoop::longest;
    } else {
        options.outer = OuterLoop::vertex;
        options.outer_vertex = std::stoi(request.outer);
    }
}

nlohmann::ordered_json domain_options_report(const MapRequest& request)
{
    using Json = nlohmann::ordered_json;
    const UniformizeOptions& options = request.options;
    const auto vertex = [](Index number) { return number < 0 ? Json() : Json(number); };
    return {{"outer", options.outer == OuterLoop::vertex ? Json(options.outer_vertex) : Json(request.outer)},
            {"center", vertex(options.center)},
            {"point", vertex(options.point)},
            {"tolerance", options.tolerance},
            {"max_sweeps", options.max_sweeps},
            {"most_lost", options.most_lost}};
}

std::vector<OutputFile> map_files(const MapRequest& request)
{
    return {{"OUT", request.output}, {"--sphere", request.sphere}, {"--json", request.json}, {"--svg", request.svg}};
}

void check_map_files(MapRequest& request)
{
    request.format = required_format(request.output);
    require_different_files(map_files(request), {request.input}, !request.quiet);
}

}  // namespace koebe::cli
