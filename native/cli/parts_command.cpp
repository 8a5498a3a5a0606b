// koebe parts IN OUT
#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/mesh_input.h"
#include "cli/option_table.h"
#include "cli/output_files.h"
#include "cli/progress_line.h"
#include "cli/result_line.h"
#include "cli/standard_streams.h"
#include "cli/subcommand.h"

#include "core/counted.h"
#include "io/atomic_file.h"
#include "io/corner_uvs.h"
#include "io/mesh_writer.h"
#include "parts/parts.h"
#include "report/json.h"
#include "report/parts_json.h"
#include "report/parts_svg.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <utility>

namespace koebe::cli {
namespace {

struct Request {
    std::string input, output, json, svg;
    WrittenFormat format = WrittenFormat::obj;
    PartsOptions options;
    bool quiet = false;

    std::vector<OutputFile> files() const { return {{"OUT", output}, {"--json", json}, {"--svg", svg}}; }
};

/// The parts' faces as filed.
void file_faces(const MeshInput& input, PartsResult& result)
{
    for (PartReport& part : result.parts) part.faces = filed_faces(input.triangulation, part.faces);
    add_input_warnings(input, result.warnings);
}

void write_files(const Request& request, const MeshInput& input, PartsResult& result, ExecutionContext& context)
{
    std::vector<AtomicFile> files;
    const std::vector<Warning> losses =
        write_with_corner_uvs(files.emplace_back(request.output), request.format, input.polygons,
                              polygon_corner_uvs(input.polygons, input.triangulation, result.uv), {input.file});
    if (!request.svg.empty()) files.emplace_back(request.svg).write(parts_svg(result.uv, result.part));
    file_faces(input, result);
    result.warnings.insert(result.warnings.end(), losses.begin(), losses.end());
    if (!request.json.empty()) {
        nlohmann::ordered_json report = to_json(result);
        report["input"] = std::filesystem::path(request.input).filename().string();
        report["options"] = option_report("parts", request.options);
        files.emplace_back(request.json).write(json_text(report));
    }
    context.checkpoint();
    for (AtomicFile& file : files) file.commit();
}

std::string result_line(const Request& request, const PartsResult& result)
{
    char figures[160];
    std::snprintf(figures, sizeof figures,
                  ", cuts %.2f of the root of the area, texel density within %.3g, angle error %.2f deg, ",
                  result.cut_length, result.density_ratio_5_95, result.distortion.angle_error_deg.mean);
    std::string line = one_line(request.output) + ": " + counted(result.parts.size(), "part") + figures +
                       std::to_string(result.distortion.flipped.size()) + " flipped";
    if (const std::size_t tiny = result.distortion.below_resolution.size(); tiny > 0)
        line += " (" + std::to_string(tiny) + " below resolution)";
    std::snprintf(figures, sizeof figures, ", %.2f s", result.seconds.total);
    return line + figures + (result.converged ? "" : ", not converged") + warning_count(result.warnings) + "\n";
}

int run(const Request& request)
{
    const CancelToken token = cancel_on_signal();
    require_writable_files(request.files(), !request.quiet);
    const MeshInput input = read_mesh_input(request.input, token);
    PartsResult result;
    {
        ProgressLine progress(request.quiet);
        ExecutionContext context(progress.callback(), token);
        PartsOptions options = request.options;
        options.polygon = input.triangulation.face;
        result = with_filed_faces(
            input, [&] { return parts_of(input.polygons.vertices, input.triangulation.triangles, options, context); });
        write_files(request, input, result, context);
    }
    if (!request.quiet) {
        print(result_line(request, result), "; the files are written");
        show_warnings(result.warnings);
    }
    return result.converged ? done : not_converged;
}

void check(Request& request)
{
    request.format = required_format(request.output);
    require_different_files(request.files(), {request.input}, !request.quiet);
}

}  // namespace

Subcommand add_parts(CLI::App& app)
{
    auto request = std::make_shared<Request>();
    CLI::App* options = app.add_subcommand("parts", "cut any surface in its UVs into even disks and tubes");
    options->add_option("IN", request->input, "any mesh: OBJ, OFF, PLY or STL")->required();
    options
        ->add_option(
            "OUT", request->output,
            "OBJ or PLY to write: the same vertices and faces, with texture coordinates of corners in [0, 1]^2")
        ->required();
    add_options(*options, "parts", request->options);
    options->add_option("--json", request->json, "write the report there")->type_name("FILE");
    options->add_option("--svg", request->svg, "write a picture of the parts there")->type_name("FILE");
    options->add_flag("--quiet", request->quiet, "no progress and no result line");
    options->callback([request] { check(*request); });
    return {options, [request] { return run(*request); }};
}

}  // namespace koebe::cli
