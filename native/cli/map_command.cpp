#include "cli/map_command.h"

#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/mapping_options.h"
#include "cli/mesh_input.h"
#include "cli/progress_line.h"
#include "cli/validators.h"
#include "io/atomic_file.h"
#include "io/obj_writer.h"
#include "report/svg.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <unistd.h>

namespace koebe::cli {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// Everything that can be known to fail is found before the computation.
void require_writable_files(const MapRequest& request)
{
    require_writable(request.output);
    if (!request.json.empty()) require_writable(request.json);
    if (!request.svg.empty()) require_writable(request.svg);
}

/// All files are complete before the first gets its name.
void write_files(const MapRequest& request, const MeshInput& input, UniformizeResult& result, Clock::time_point begin,
                 ExecutionContext& context)
{
    const auto begin_write = Clock::now();
    std::vector<AtomicFile> files;
    write_obj_with_uvs(files.emplace_back(request.output), input.polygons, result.uv);
    if (!request.svg.empty()) files.emplace_back(request.svg).write(to_svg(result, input.polygons));
    result.seconds.write = seconds_since(begin_write);
    result.seconds.total = seconds_since(begin);
    if (!request.json.empty()) {
        nlohmann::ordered_json report = to_json(result);
        report["input"] = std::filesystem::path(request.input).filename().string();
        for (const auto& [name, value] : request.names) report[name] = value;
        files.emplace_back(request.json).write(report.dump(1) + "\n");
    }
    context.checkpoint();
    for (AtomicFile& file : files) file.commit();
}

void print_result_line(const MapRequest& request, const UniformizeResult& result)
{
    double roundness = 0.0;
    for (const LoopReport& loop : result.loops) roundness = std::max(roundness, loop.roundness);
    const auto count = [](std::size_t n, const char* noun) {
        return std::to_string(n) + " " + noun + (n == 1 ? "" : "s");
    };
    std::printf("%s: %s, %s, roundness %.1e, angle error %.2f deg, %zu flipped", request.output.c_str(),
                count(result.loops.size(), "loop").c_str(),
                count(static_cast<std::size_t>(result.sweeps), "sweep").c_str(), roundness,
                result.distortion.angle_error_deg.mean, result.distortion.flipped.size());
    if (!result.distortion.below_resolution.empty())
        std::printf(" (%zu below resolution)", result.distortion.below_resolution.size());
    std::printf(", %.2f s%s\n", result.seconds.total, result.converged ? "" : ", not converged");
}

/// For people only: scripts find the warnings in the JSON.
void print_warnings(const UniformizeResult& result)
{
    if (::isatty(STDERR_FILENO) != 1) return;
    for (const std::string& warning : result.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
}

/// @throws CLI::ValidationError two of the files to write are one
void require_different_files(const MapRequest& request)
{
    const auto same = [](const std::string& a, const std::string& b) {
        return !a.empty() && std::filesystem::path(a).lexically_normal() == std::filesystem::path(b).lexically_normal();
    };
    if (same(request.output, request.json) || same(request.output, request.svg) || same(request.json, request.svg))
        throw CLI::ValidationError("OUT, --json and --svg", "must be different files");
}

}  // namespace

void add_mesh_arguments(CLI::App& app, MapRequest& request)
{
    app.add_option("IN", request.input, "surface with holes: OBJ, OFF, PLY or STL")->required();
    app.add_option("OUT", request.output, "OBJ to write: the same vertices and faces, with vt in [0, 1]^2")->required();
}

void add_map_options(CLI::App& app, MapRequest& request)
{
    UniformizeOptions& options = request.options;
    app.add_option("--outer", request.outer, "loop for the unit circle: auto, longest, or that of a vertex (from 0)")
        ->check(outer_loop_choice())
        ->type_name("auto|longest|VERTEX")
        ->capture_default_str();
    add_mapping_options(app, options);
    app.add_option("--json", request.json, "write the report there")->type_name("FILE");
    app.add_option("--svg", request.svg, "write a picture of the circle domain there")->type_name("FILE");
    app.add_flag("--quiet", request.quiet, "no progress and no result line");
}

void check_map_options(MapRequest& request)
{
    require_different_files(request);
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

int run_map(const MapRequest& request, const MapFunction& compute)
{
    const auto begin = Clock::now();
    const CancelToken token = cancel_on_signal();
    require_writable_files(request);
    const MeshInput input = read_mesh_input(request.input, token);
    UniformizeResult result;
    {
        ProgressLine progress(request.quiet);
        ExecutionContext context(progress.callback(), token);
        result = with_filed_faces(
            input, [&] { return compute(input.polygons.vertices, input.triangulation.triangles, context); });
        result.seconds.read = input.seconds;
        result.warnings.insert(result.warnings.begin(), input.warnings.begin(), input.warnings.end());
        write_files(request, input, result, begin, context);
    }
    if (!request.quiet) {
        print_result_line(request, result);
        print_warnings(result);
    }
    return result.converged ? done : not_converged;
}

}  // namespace koebe::cli
