#include "cli/map_command.h"

#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/loop_options.h"
#include "cli/mapping_options.h"
#include "cli/mesh_input.h"
#include "cli/output_files.h"
#include "cli/progress_line.h"
#include "cli/result_line.h"
#include "cli/standard_streams.h"
#include "cli/validators.h"
#include "core/counted.h"
#include "io/atomic_file.h"
#include "report/svg.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace koebe::cli {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

std::vector<OutputFile> output_files(const MapRequest& request)
{
    return {{"OUT", request.output}, {"--json", request.json}, {"--svg", request.svg}};
}

/// All files are complete before the first gets its name.
void write_files(const MapRequest& request, const MeshInput& input, UniformizeResult& result, Clock::time_point begin,
                 ExecutionContext& context)
{
    const auto begin_write = Clock::now();
    std::vector<AtomicFile> files;
    write_with_uvs(files.emplace_back(request.output), request.format, input.polygons, result.uv);
    if (!request.svg.empty()) files.emplace_back(request.svg).write(to_svg(result, input.polygons));
    result.seconds.write = seconds_since(begin_write);
    result.seconds.total = seconds_since(begin);
    if (!request.json.empty()) {
        nlohmann::ordered_json report = to_json(result);
        report["input"] = std::filesystem::path(request.input).filename().string();
        if (!input.sha256.empty()) report["input_sha256"] = input.sha256;
        report.update(request.entries);
        files.emplace_back(request.json).write(json_text(report));
    }
    context.checkpoint();
    for (AtomicFile& file : files) file.commit();
}

std::string result_line(const MapRequest& request, const UniformizeResult& result)
{
    double roundness = 0.0;
    for (const LoopReport& loop : result.loops) roundness = std::max(roundness, loop.roundness.paper);
    const auto rounded = [](const char* format, double number) {
        char text[32];
        std::snprintf(text, sizeof text, format, number);
        return std::string(text);
    };
    std::string line = one_line(request.output) + ": " + counted(result.loops.size(), "loop") + ", " +
                       counted(static_cast<std::size_t>(result.sweeps), "sweep") + ", roundness " +
                       rounded("%.1e", roundness) + ", angle error " +
                       rounded("%.2f", result.distortion.angle_error_deg.mean) + " deg, " +
                       std::to_string(result.distortion.flipped.size()) + " flipped";
    if (const std::size_t tiny = result.distortion.below_resolution.size(); tiny > 0)
        line += " (" + std::to_string(tiny) + " below resolution)";
    line += ", " + rounded("%.2f", result.seconds.total) + " s";
    if (!result.converged) line += ", not converged";
    return line + warning_count(result.warnings) + "\n";
}

/// All of them, for people only: scripts find them in the JSON.
void show_warnings(const UniformizeResult& result)
{
    if (!is_error_shown()) return;
    for (const Warning& warning : result.warnings) std::fprintf(stderr, "warning: %s\n", warning.text().c_str());
}

}  // namespace

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
            {"max_sweeps", options.max_sweeps}};
}

void check_map_files(MapRequest& request)
{
    request.format = required_format(request.output);
    require_different_files(output_files(request), {request.input}, !request.quiet);
}

int run_map(const MapRequest& request, const MapFunction& compute)
{
    const auto begin = Clock::now();
    const CancelToken token = cancel_on_signal();
    require_writable_files(output_files(request), !request.quiet);
    const MeshInput input = read_mesh_input(request.input, token);
    UniformizeResult result;
    {
        ProgressLine progress(request.quiet);
        ExecutionContext context(progress.callback(), token);
        result = with_filed_faces(input, [&] {
            require_fitting_vertices(input, request.options);
            return compute(input.polygons.vertices, input.triangulation.triangles, context);
        });
        result.seconds.read = input.seconds;
        add_input_warnings(input, result.warnings);
        write_files(request, input, result, begin, context);
    }
    if (!request.quiet) {
        print(result_line(request, result), "; the files are written");
        show_warnings(result);
    }
    return result.converged ? done : not_converged;
}

}  // namespace koebe::cli
