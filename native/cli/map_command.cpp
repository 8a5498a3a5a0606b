#include "cli/map_command.h"

#include "cli/loop_options.h"
#include "cli/map_run.h"
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

void add_report_options(CLI::App& app, MapRequest& request)
{
    app.add_option("--json", request.json, "write the report there")->type_name("FILE");
    app.add_option("--svg", request.svg, "write a picture of the circle domain there")->type_name("FILE");
    app.add_flag("--quiet", request.quiet, "no progress and no result line");
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

void add_losses(const std::string& file, const std::vector<Warning>& losses, std::vector<Warning>& warnings)
{
    for (Warning loss : losses) {
        loss.sentence = file + loss.sentence;
        warnings.push_back(std::move(loss));
    }
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
