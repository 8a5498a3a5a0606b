// The road from an input file to the written map, whatever the kind of map: read, compute, write all or none, tell.
#pragma once

#include "cli/exit_code.h"
#include "cli/interrupt.h"
#include "cli/map_command.h"
#include "cli/mesh_input.h"
#include "cli/output_files.h"
#include "cli/progress_line.h"
#include "cli/result_line.h"
#include "cli/roomy_heap.h"
#include "cli/standard_streams.h"
#include "core/thread_share.h"
#include "core/warning.h"
#include "io/atomic_file.h"
#include "io/corner_uvs.h"
#include "io/mesh_writer.h"
#include "quality/distortion.h"

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace koebe::cli {

/// What the kinds of map differ in. The result has `seconds`, `converged`, `warnings` and `distortion`.
template <typename Result>
struct MapKind {
    bool any_polygon = false;  ///< of ReadOptions
    bool many_pieces = false;  ///< that threads work on side by side
    /// All numbers in the result are the file's.
    std::function<Result(const MeshInput&, ExecutionContext&)> compute;
    /// What of the file is not kept, or replaced.
    std::function<std::vector<Warning>(AtomicFile&, const MeshInput&, const Result&)> write_mesh;
    /// Of a request with such a file; likewise.
    std::function<std::vector<Warning>(AtomicFile&, const MeshInput&, const Result&)> write_sphere;
    std::function<std::string(const MeshInput&, const Result&)> draw;
    std::function<nlohmann::ordered_json(const Result&)> report;
    std::function<std::string(const Result&)> first_words;  ///< of the result line, after the file's name
};

/// The kind of a map to the disk, its computation left out.
MapKind<UniformizeResult> disk_map(const MapRequest& request);

/// The kind of a map whose UVs are of corners, by the file's polygons: how it is computed and written.
template <typename Result, typename Options>
MapKind<Result> corner_map(const MapRequest& request, const Options& chosen,
                           Result (*map)(const Vertices&, const Triangles&, const Options&, ExecutionContext&))
{
    MapKind<Result> kind;
    kind.compute = [&chosen, map](const MeshInput& input, ExecutionContext& context) {
        Options options = chosen;
        options.polygon = input.triangulation.face;
        Result result = with_filed_faces(
            input, [&] { return map(input.polygons.vertices, input.triangulation.triangles, options, context); });
        result.turned = filed_faces(input.triangulation, result.turned);
        add_input_warnings(input, result.warnings);
        return result;
    };
    kind.write_mesh = [&request](AtomicFile& file, const MeshInput& input, const Result& result) {
        return write_with_corner_uvs(file, request.format, input.polygons,
                                     polygon_corner_uvs(input.polygons, input.triangulation, result.uv), {input.file});
    };
    return kind;
}

/// The files of a request, by the names that the usage has for them.
std::vector<OutputFile> map_files(const MapRequest& request);

/// A number in a printf format.
std::string rounded(const char* format, double number);

/// The result line: the file, the first words, and what all maps have.
std::string map_line(const MapRequest& request, const std::string& first_words, const Distortion& distortion,
                     double seconds, bool converged, const std::vector<Warning>& warnings);

/// Adds what a file that is written does not keep. @param file which of the files, before the sentence
void add_losses(const std::string& file, const std::vector<Warning>& losses, std::vector<Warning>& warnings);

/// All files are complete before the first gets its name.
template <typename Result>
void write_map(const MapRequest& request, const MapKind<Result>& kind, const MeshInput& input, Result& result,
               std::chrono::steady_clock::time_point begin, ExecutionContext& context)
{
    using Clock = std::chrono::steady_clock;
    const auto since = [](Clock::time_point then) {
        return std::chrono::duration<double>(Clock::now() - then).count();
    };
    const auto begin_write = Clock::now();
    const ThreadShare threads(request.options.threads);
    std::vector<AtomicFile> files;
    add_losses("", kind.write_mesh(files.emplace_back(request.output), input, result), result.warnings);
    if (!request.sphere.empty())
        add_losses("--sphere: ", kind.write_sphere(files.emplace_back(request.sphere), input, result), result.warnings);
    if (!request.svg.empty()) files.emplace_back(request.svg).write(kind.draw(input, result));
    result.seconds.write = since(begin_write);
    result.seconds.total = since(begin);
    if (!request.json.empty()) {
        nlohmann::ordered_json report = kind.report(result);
        report["input"] = std::filesystem::path(request.input).filename().string();
        if (!input.sha256.empty()) report["input_sha256"] = input.sha256;
        report.update(request.entries);
        files.emplace_back(request.json).write(json_text(report));
    }
    context.checkpoint();
    for (AtomicFile& file : files) file.commit();
}

/// Reads, computes, writes all files or none, and prints the result line.
/// @return an ExitCode
template <typename Result>
int run_map_of(const MapRequest& request, const MapKind<Result>& kind)
{
    const auto begin = std::chrono::steady_clock::now();
    const CancelToken token = cancel_on_signal();
    if (!kind.many_pieces) take_roomy_heap();
    require_writable_files(map_files(request), !request.quiet);
    const MeshInput input = read_mesh_input(
        request.input, token,
        {.any_polygon = kind.any_polygon, .hash = !request.json.empty(), .threads = request.options.threads});
    Result result;
    {
        ProgressLine progress(request.quiet);
        ExecutionContext context(progress.callback(), token);
        result = kind.compute(input, context);
        result.seconds.read = input.seconds;
        write_map(request, kind, input, result, begin, context);
    }
    if (!request.quiet) {
        print(map_line(request, kind.first_words(result), result.distortion, result.seconds.total, result.converged,
                       result.warnings),
              "; the files are written");
        show_warnings(result.warnings);
    }
    return result.converged ? done : not_converged;
}

}  // namespace koebe::cli
