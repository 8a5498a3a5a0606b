// koebe lift SURFACE PATTERN OUT
#include "cli/commands/map_run.h"
#include "cli/commands/subcommand.h"
#include "cli/options/option_table.h"

#include "core/counted.h"
#include "io/extension.h"
#include "io/stl_writer.h"
#include "lift/lift.h"
#include "lift/patterns.h"
#include "report/lift_json.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <memory>

namespace koebe::cli {
namespace {

struct LiftRequest {
    std::string surface, pattern, output, json;
    WrittenFormat format = WrittenFormat::obj;
    bool stl = false, quiet = false;
    LiftOptions chosen;
    nlohmann::ordered_json entries = nlohmann::ordered_json::object();

    std::vector<OutputFile> files() const { return {{"OUT", output}, {"--json", json}}; }
};

void write_lifted(AtomicFile& file, const LiftRequest& request, const LiftResult& result)
{
    if (request.stl) return write_stl(file, result.vertices, result.triangles);
    PolygonMesh mesh{result.vertices, {result.triangles.data(), result.triangles.data() + result.triangles.size()}};
    for (Index f = 1; f <= static_cast<Index>(result.triangles.rows()); ++f) mesh.face_begin.push_back(3 * f);
    const MeshFile no_file;
    if (result.uv.rows() > 0)
        write_with_corner_uvs(file, request.format, mesh, result.uv, {no_file});
    else
        write_with_patches(file, request.format, mesh, result.patch, std::vector<char>(result.patch.size(), 0),
                           {no_file});
}

std::string lifted_line(const LiftRequest& request, const LiftResult& result)
{
    char time[32];
    std::snprintf(time, sizeof time, ", %.2f s", result.seconds.total);
    return one_line(request.output) + ": " + counted(static_cast<std::size_t>(result.outlines), "outline") +
           (request.chosen.perforate ? " cut out" : " raised") + ", " +
           counted(static_cast<std::size_t>(result.triangles.rows()), "face") + ", " +
           (result.uv.rows() == 0 ? "closed" : counted(static_cast<std::size_t>(result.loops_after), "loop")) + time +
           (result.converged ? "" : ", not converged") + warning_count(result.warnings) + "\n";
}

int run_lift(const LiftRequest& request)
{
    const CancelToken token = cancel_on_signal();
    require_writable_files(request.files(), !request.quiet);
    const MeshInput input = read_mesh_input(request.surface, token, {.keep_file = false});
    LiftResult result;
    {
        ProgressLine progress(request.quiet);
        ExecutionContext context(progress.callback(), token);
        result = with_filed_faces(input, [&] {
            return lift(input.polygons.vertices, input.triangulation.triangles, request.pattern, request.chosen,
                        context);
        });
    }
    add_input_warnings(input, result.warnings);
    result.seconds.read = input.seconds;
    std::vector<AtomicFile> files;
    write_lifted(files.emplace_back(request.output), request, result);
    if (!request.json.empty()) {
        nlohmann::ordered_json report = to_json(result);
        report["input"] = std::filesystem::path(request.surface).filename().string();
        report.update(request.entries);
        files.emplace_back(request.json).write(json_text(report));
    }
    if (token.cancelled()) throw Cancelled();
    for (AtomicFile& file : files) file.commit();
    if (!request.quiet) {
        print(lifted_line(request, result), "; the files are written");
        show_warnings(result.warnings);
    }
    return result.converged ? done : not_converged;
}

std::string pattern_help()
{
    std::string names;
    for (const std::string& name : pattern_names()) names += (names.empty() ? "" : ", ") + name;
    return names;
}

}  // namespace

Subcommand add_lift(CLI::App& app)
{
    auto request = std::make_shared<LiftRequest>();
    CLI::App* options = app.add_subcommand("lift", "a flat pattern on a surface: as holes, as a relief, as a solid");
    options->add_option("SURFACE", request->surface, "surface: OBJ, OFF, PLY or STL")->required();
    options->add_option("PATTERN", request->pattern, pattern_help())->required()->check(CLI::IsMember(pattern_names()));
    options
        ->add_option("OUT", request->output,
                     "OBJ or PLY to write, with texture coordinates unless it is a solid, or STL")
        ->required();
    add_options(*options, "lift", request->chosen);
    options->add_option("--json", request->json, "write the report there")->type_name("FILE");
    options->add_flag("--quiet", request->quiet, "no progress and no result line");
    options->callback([request] {
        request->stl = io::lower_extension(request->output) == ".stl";
        if (!request->stl) request->format = required_format(request->output);
        require_different_files(request->files(), {request->surface}, !request->quiet);
        request->entries["options"] = option_report("lift", request->chosen);
    });
    return {options, [request] { return run_lift(*request); }};
}

}  // namespace koebe::cli
