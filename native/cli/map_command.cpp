#include "cli/map_command.h"

#include "cli/loop_options.h"
#include "cli/map_run.h"
#include "cli/mapping_options.h"
#include "cli/validators.h"
#include "core/counted.h"
#include "report/svg.h"

#include <algorithm>
#include <cstdio>
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

void check_map_files(MapRequest& request)
{
    request.format = required_format(request.output);
    require_different_files(map_files(request), {request.input}, !request.quiet);
}

std::vector<OutputFile> map_files(const MapRequest& request)
{
    return {{"OUT", request.output}, {"--sphere", request.sphere}, {"--json", request.json}, {"--svg", request.svg}};
}

std::string rounded(const char* format, double number)
{
    char text[32];
    std::snprintf(text, sizeof text, format, number);
    return text;
}

std::string map_line(const MapRequest& request, const std::string& first_words, const Distortion& distortion,
                     double seconds, bool converged, const std::vector<Warning>& warnings)
{
    std::string line = one_line(request.output) + ": " + first_words + ", angle error " +
                       rounded("%.2f", distortion.angle_error_deg.mean) + " deg, " +
                       std::to_string(distortion.flipped.size()) + " flipped";
    if (const std::size_t tiny = distortion.below_resolution.size(); tiny > 0)
        line += " (" + std::to_string(tiny) + " below resolution)";
    line += ", " + rounded("%.2f", seconds) + " s";
    if (!converged) line += ", not converged";
    return line + warning_count(warnings) + "\n";
}

MapKind<UniformizeResult> disk_map(const MapRequest& request)
{
    MapKind<UniformizeResult> kind;
    kind.write_mesh = [format = request.format](AtomicFile& file, const MeshInput& input,
                                                const UniformizeResult& result) {
        return write_with_uvs(file, format, input.polygons, result.uv, {input.file});
    };
    kind.draw = [](const MeshInput& input, const UniformizeResult& result) { return to_svg(result, input.polygons); };
    kind.report = [](const UniformizeResult& result) { return to_json(result); };
    kind.first_words = [](const UniformizeResult& result) {
        double roundness = 0.0;
        for (const LoopReport& loop : result.loops) roundness = std::max(roundness, loop.roundness.paper);
        return counted(result.loops.size(), "loop") + ", " + counted(static_cast<std::size_t>(result.sweeps), "sweep") +
               ", roundness " + rounded("%.1e", roundness);
    };
    return kind;
}

int run_map(const MapRequest& request, const MapFunction& compute)
{
    MapKind<UniformizeResult> kind = disk_map(request);
    kind.compute = [&](const MeshInput& input, ExecutionContext& context) {
        UniformizeResult result = with_filed_faces(input, [&] {
            require_fitting_vertices(input, request.options);
            return compute(input.polygons.vertices, input.triangulation.triangles, context);
        });
        add_input_warnings(input, result.warnings);
        return result;
    };
    return run_map_of(request, kind);
}

}  // namespace koebe::cli
