// Runs any kind of map from an input file to the written files: reads, computes, writes all files or none, reports.
#pragma once

#include "cli/commands/map_kind.h"
#include "cli/commands/scene_run.h"
#include "cli/process/interrupt.h"
#include "cli/process/progress_line.h"
#include "cli/process/result_line.h"
#include "cli/process/standard_streams.h"
#include "execution/stopwatch.h"
#include "execution/thread_share.h"
#include "exit_code.h"
#include "files/extension.h"
#include "report/json.h"

#include <filesystem>
#include <vector>

namespace koebe::cli {

/// Writes the files of a map. All are complete before the first one gets its name.
template <typename Result>
void write_map(const MapRequest& request, const MapKind<Result>& kind, const MeshInput& input, Result& result,
               const Stopwatch& run, ExecutionContext& context)
{
    const Stopwatch writing;
    context.begin_stage("write", 1.0, 1.0);
    const ThreadShare threads(request.options.threads);
    std::vector<AtomicFile> files;
    add_losses("", kind.write_mesh(files.emplace_back(request.output), input, result), result.warnings);
    if (!request.sphere.empty())
        add_losses("--sphere: ", kind.write_sphere(files.emplace_back(request.sphere), input, result), result.warnings);
    kind.write_more(files, result);
    if (!request.svg.empty()) files.emplace_back(request.svg).write(kind.draw(input, result));
    result.seconds.write = writing.elapsed();
    result.seconds.total = run.elapsed();
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

/// Reads, computes, writes all files or none, and prints the result line.
/// @return an ExitCode
template <typename Result>
int run_map_of(const MapRequest& request, const MapKind<Result>& kind)
{
    if (io::lower_extension(request.output) == glb_extension) return run_scene_of(request, kind);
    const Stopwatch run;
    const CancelToken token = cancel_on_signal();
    const ReadOptions options = begin_run(request, kind);
    const MeshInput input = read_mesh_input(request.input, token, options);
    Result result;
    {
        ProgressLine progress(request.quiet);
        ExecutionContext context(progress.callback(), token);
        result = kind.compute(input, context);
        result.seconds.read = input.seconds;
        write_map(request, kind, input, result, run, context);
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
