#include "cli/cut_map_command.h"

#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/loop_options.h"
#include "cli/mesh_input.h"
#include "cli/output_files.h"
#include "cli/progress_line.h"
#include "cli/result_line.h"
#include "cli/standard_streams.h"
#include "core/counted.h"
#include "io/atomic_file.h"
#include "io/corner_uvs.h"
#include "pipeline/cut_uniformize.h"
#include "report/cut_json.h"
#include "report/svg.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace koebe::cli {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// Makes all faces that the report names those of the file.
void name_filed_faces(const MeshInput& input, CutUniformizeResult& result)
{
    const auto filed = [&](std::vector<Index>& faces) { faces = filed_faces(input.triangulation, faces); };
    for (MappedPiece& piece : result.pieces) {
        filed(piece.faces);
        for (Warning& warning : piece.map.warnings)
            if (elements_of(warning.kind) == ElementKind::faces) filed(warning.elements);
    }
    filed(result.turned);
    std::vector<LeftOutFace> left_out;
    for (LeftOutFace out : result.left_out) {
        out.face = input.triangulation.face[out.face];
        if (out.like >= 0) out.like = input.triangulation.face[out.like];
        if (left_out.empty() || left_out.back().face != out.face) left_out.push_back(out);
    }
    result.left_out = std::move(left_out);
    add_input_warnings(input, result.warnings);
}

/// All files are complete before the first gets its name.
void write_files(const MapRequest& request, const MeshInput& input, CutUniformizeResult& result,
                 Clock::time_point begin, ExecutionContext& context)
{
    const auto begin_write = Clock::now();
    const PlanarPoints corner_uvs = polygon_corner_uvs(input.polygons, input.triangulation, result.uv);
    std::vector<AtomicFile> files;
    write_with_corner_uvs(files.emplace_back(request.output), request.format, input.polygons, corner_uvs);
    if (!request.svg.empty()) files.emplace_back(request.svg).write(to_svg(result, input.polygons, corner_uvs));
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

std::string figure(const char* format, double number)
{
    char text[32];
    std::snprintf(text, sizeof text, format, number);
    return text;
}

std::string result_line(const MapRequest& request, const CutUniformizeResult& result)
{
    std::string line = one_line(request.output) + ": " + counted(result.pieces.size(), "piece") + ", " +
                       counted(result.cuts.size(), "cut") + ", angle error " +
                       figure("%.2f", result.distortion.angle_error_deg.mean) + " deg, " +
                       std::to_string(result.distortion.flipped.size()) + " flipped";
    if (const std::size_t tiny = result.distortion.below_resolution.size(); tiny > 0)
        line += " (" + std::to_string(tiny) + " below resolution)";
    line += ", " + figure("%.2f", result.seconds.total) + " s";
    if (!result.converged) line += ", not converged";
    return line + warning_count(result.warnings) + "\n";
}

}  // namespace

int run_cut_map(const MapRequest& request)
{
    const auto begin = Clock::now();
    const CancelToken token = cancel_on_signal();
    const std::vector<OutputFile> outputs{{"OUT", request.output}, {"--json", request.json}, {"--svg", request.svg}};
    require_writable_files(outputs, !request.quiet);
    const MeshInput input = read_mesh_input(request.input, token, true);
    CutUniformizeResult result;
    {
        ProgressLine progress(request.quiet);
        ExecutionContext context(progress.callback(), token);
        require_fitting_vertices(input, request.options);
        result = uniformize_with_cuts(input.polygons.vertices, input.triangulation.triangles, input.triangulation.face,
                                      request.options, context);
        result.seconds.read = input.seconds;
        name_filed_faces(input, result);
        write_files(request, input, result, begin, context);
    }
    if (!request.quiet) {
        print(result_line(request, result), "; the files are written");
        if (is_error_shown())
            for (const Warning& warning : result.warnings)
                std::fprintf(stderr, "warning: %s\n", warning.text().c_str());
    }
    return result.converged ? done : not_converged;
}

}  // namespace koebe::cli
