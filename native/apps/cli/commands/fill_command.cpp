// koebe fill IN OUT
#include "cli/commands/subcommand.h"
#include "cli/files/mesh_input.h"
#include "cli/files/output_files.h"
#include "cli/options/loop_options.h"
#include "cli/options/map_request.h"
#include "cli/options/option_table.h"
#include "cli/options/validators.h"
#include "cli/process/interrupt.h"
#include "cli/process/result_line.h"
#include "cli/process/standard_streams.h"
#include "exit_code.h"

#include "core/counted.h"
#include "execution/detachable_run.h"
#include "execution/stopwatch.h"
#include "files/atomic_file.h"
#include "holes/fan_filling.h"

#include <memory>
#include <set>
#include <utility>

namespace koebe::cli {
namespace {

struct FillRequest {
    std::string input, output, outer = "longest";
    const MeshFormat* format = nullptr;
    std::vector<Index> loops;
    FileOptions of_files;
    bool all = false, quiet = false;

    std::vector<OutputFile> files() const { return {{"OUT", output}}; }
};

/// Polygons with the patch of each: -1 the surface, k the patch of loop k.
struct PatchedPolygons {
    PolygonMesh mesh;
    std::vector<Index> patch;
    std::vector<Warning> warnings;
};

/// Joins the polygons as filed and the patches.
PatchedPolygons join(const MeshInput& input, FilledSurface filled)
{
    const Eigen::Index first = input.triangulation.triangles.rows();
    PatchedPolygons result{input.polygons, {}, std::move(filled.warnings)};
    result.mesh.vertices = std::move(filled.vertices);
    result.patch.assign(static_cast<std::size_t>(input.polygons.face_count()), -1);
    std::vector<Index>& corners = result.mesh.corners;
    for (Eigen::Index t = first; t < filled.triangles.rows(); ++t) {
        for (const Index v : filled.triangles.row(t)) corners.push_back(v);
        result.mesh.face_begin.push_back(static_cast<Index>(corners.size()));
        result.patch.push_back(filled.label[t]);
    }
    add_input_warnings(input, result.warnings);
    return result;
}

/// The ranks of the loops to fill.
std::vector<Index> chosen_loops(const FillRequest& request, const Vertices& vertices, const Surface& surface)
{
    require_ranks(request.loops, surface.loops.size());
    if (!request.loops.empty()) return request.loops;
    std::vector<Index> ranks = chosen_ranks(surface, std::nullopt);
    if (request.all || ranks.empty()) return ranks;
    const Index outer =
        request.outer == "longest" ? longest_loop(vertices, surface) : loop_of(surface, std::stoi(request.outer));
    ranks.erase(ranks.begin() + outer);
    return ranks;
}

PatchedPolygons fill(const FillRequest& request, const MeshInput& input)
{
    return with_filed_faces(input, [&] {
        const Vertices& vertices = input.polygons.vertices;
        const Triangles& triangles = input.triangulation.triangles;
        const Surface surface = analyze_surface(triangles, static_cast<Index>(vertices.rows()));
        return join(input, fill_holes(vertices, triangles, chosen_loops(request, vertices, surface)));
    });
}

std::string result_line(const FillRequest& request, const MeshInput& input, const PatchedPolygons& filled,
                        double seconds, const std::vector<Warning>& warnings)
{
    const std::set<Index> patches(filled.patch.begin(), filled.patch.end());
    const std::size_t loops = patches.size() - patches.count(-1);
    const Index added = filled.mesh.face_count() - input.polygons.face_count();
    return one_line(request.output) + ": " + counted(loops, "loop") + " filled, " +
           counted(static_cast<std::size_t>(added), "face") + " added" + last_words(seconds, true, warnings);
}

int run_fill(const FillRequest& request)
{
    // Read and fill, on a thread that Ctrl-C leaves behind.
    const Stopwatch run;
    const CancelToken token = cancel_on_signal();
    require_writable_files(request.files(), !request.quiet);
    const auto input =
        std::make_shared<const MeshInput>(read_mesh_input(request.input, token, {.weld = request.of_files.weld}));
    ExecutionContext context({}, token);
    const PatchedPolygons filled =
        run_detachable<PatchedPolygons>(context, [request, input](ExecutionContext&) { return fill(request, *input); });
    // The file appears whole, or not at all.
    AtomicFile file(request.output);
    std::vector<Warning> warnings = filled.warnings;
    if (filled.mesh.face_count() == input->polygons.face_count())
        warnings.push_back({WarningKind::no_hole, "there is no hole: the only boundary is the outer one"});
    const std::vector<Warning> losses =
        write_with_patches(file, *request.format, filled.mesh, filled.patch, {input->file});
    warnings.insert(warnings.end(), losses.begin(), losses.end());
    context.checkpoint();
    file.commit();

    const double seconds = run.elapsed();
    if (!request.quiet) {
        print(result_line(request, *input, filled, seconds, warnings), "; the file is written");
        show_warnings(warnings);
    }
    return done;
}

void check(FillRequest& request)
{
    request.format = required_format(request.output);
    require_different_files(request.files(), {}, !request.quiet);
}

}  // namespace

Subcommand add_fill(CLI::App& app)
{
    auto request = std::make_shared<FillRequest>();
    CLI::App* options = app.add_subcommand("fill", "fill the holes of a surface: all loops but the outer one");
    add_input(*options, request->input, "surface with holes");
    add_output(*options, request->output,
               "OBJ to write, with the groups surface, patch_0, patch_1, …, or PLY, with the property patch");
    // Which loops are filled: all but the outer one, all, or a list.
    CLI::Option* outer = options
                             ->add_option("--outer", request->outer,
                                          "loop that stays open: the longest, or the loop of a vertex (counted from 0)")
                             ->check(outer_loop_choice({"longest"}))
                             ->type_name("longest|VERTEX")
                             ->capture_default_str();
    CLI::Option* all = options->add_flag("--all", request->all, "fill the outer loop too: the surface is closed");
    options
        ->add_option("--loops", request->loops,
                     "fill only these loops, for example 0,2. Loops are numbered by their lowest vertices")
        ->delimiter(',')
        ->check(whole_number(0))
        ->excludes(outer)
        ->excludes(all);
    outer->excludes(all);
    add_options(*options, "shapes", request->of_files);
    options->add_flag("--quiet", request->quiet, "no result line");
    options->callback([request] { check(*request); });
    return {options, [request] { return run_fill(*request); }};
}

}  // namespace koebe::cli
