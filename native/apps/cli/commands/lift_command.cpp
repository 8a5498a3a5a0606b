// koebe lift SURFACE PATTERN OUT
#include "cli/commands/map_run.h"
#include "cli/commands/subcommand.h"
#include "cli/commands/weights_option.h"
#include "cli/options/option_table.h"

#include "core/counted.h"
#include "files/extension.h"
#include "io/stl_writer.h"
#include "io/three_mf_writer.h"
#include "lift/lift.h"
#include "lift/patterns.h"
#include "report/lift_json.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace koebe::cli {
namespace {

struct LiftRequest : MapRequest {
    std::string pattern;
    std::string solid_format;  // .stl or .3mf; empty: a format of maps
    LiftOptions chosen;
    WeightsOption graded;
};

std::vector<Warning> write_lifted(AtomicFile& file, const LiftRequest& request, const LiftResult& result)
{
    if (request.solid_format == ".stl") write_stl(file, result.vertices, result.triangles);
    if (request.solid_format == ".3mf")
        write_three_mf(file, result.vertices, result.triangles, result.loops_after == 0 || result.uv.rows() == 0);
    if (!request.solid_format.empty()) return {};
    PolygonMesh mesh{result.vertices, {result.triangles.data(), result.triangles.data() + result.triangles.size()}};
    for (Index f = 1; f <= static_cast<Index>(result.triangles.rows()); ++f) mesh.face_begin.push_back(3 * f);
    const MeshFile no_file;
    if (result.uv.rows() > 0) return write_with_corner_uvs(file, *request.format, mesh, result.uv, {no_file});
    return write_with_patches(file, *request.format, mesh, result.patch, {no_file});
}

class LiftKind final : public MapKind<LiftResult> {
public:
    explicit LiftKind(const LiftRequest& request) : request_(request) {}

    LiftResult compute(const MeshInput& input, ExecutionContext& context) const override
    {
        LiftOptions chosen = request_.chosen;
        chosen.graded = request_.graded.read("a share of the size");
        name_mapped_vertices(input, chosen);
        LiftResult result = with_filed_faces(input, [&] {
            return lift(input.polygons.vertices, input.triangulation.triangles, request_.pattern, chosen, context);
        });
        add_input_warnings(input, result.warnings);
        return result;
    }
    std::vector<Warning> write_mesh(AtomicFile& file, const MeshInput&, const LiftResult& result) const override
    {
        return write_lifted(file, request_, result);
    }
    std::string first_words(const LiftResult& result) const override
    {
        if (io::lower_extension(request_.pattern) == ".obj" && is_pattern_file(request_.pattern))
            return "bent, " + counted(static_cast<std::size_t>(result.face_count), "face");
        return (result.outlines == 0 ? "relief, "  // of an image
                                     : counted(static_cast<std::size_t>(result.outlines), "outline") +
                                           (request_.chosen.perforate ? " cut out, " : " raised, ")) +
               counted(static_cast<std::size_t>(result.face_count), "face") + ", " +
               (result.uv.rows() == 0 ? "closed" : counted(static_cast<std::size_t>(result.loops_after), "loop"));
    }

private:
    const LiftRequest& request_;
};

std::string pattern_help()
{
    std::string names;
    for (const std::string& name : pattern_names()) names += (names.empty() ? "" : ", ") + name;
    return names + ", or an SVG, PNG or OBJ file";
}

std::string not_a_pattern(const std::string& pattern)
{
    if (is_pattern_file(pattern) || std::ranges::find(pattern_names(), pattern) != pattern_names().end()) return {};
    return "the patterns are " + pattern_help();
}

}  // namespace

Subcommand add_lift(CLI::App& app)
{
    auto request = std::make_shared<LiftRequest>();
    CLI::App* options = app.add_subcommand("lift", "a flat pattern on a surface: as holes, as a relief, as a solid");
    add_input(*options, request->input, "surface", "SURFACE");
    options->add_option("PATTERN", request->pattern, pattern_help())
        ->required()
        ->check(CLI::Validator(not_a_pattern, ""));
    add_output(*options, request->output,
               io::listed_formats(io::FormatName::word, true) +
                   " to write, with texture coordinates unless it is a solid, or STL or 3MF");
    add_options(*options, "lift", request->chosen);
    add_options(*options, "lift", request->of_files);
    request->graded.add(*options, "lift", "graded");
    add_report_options(*options, *request, "");
    // The extension decides between a mesh with UVs and a solid for a printer. A pattern's file must not be
    // overwritten.
    options->callback([request] {
        const std::string extension = io::lower_extension(request->output);
        if (extension == ".stl" || extension == ".3mf") request->solid_format = extension;
        if (request->solid_format.empty()) request->format = required_format(request->output);
        std::vector<std::string> inputs{request->input};
        if (is_pattern_file(request->pattern)) inputs.push_back(request->pattern);
        require_different_files(map_files(*request), inputs, !request->quiet);
        report_options(*request, "lift", request->chosen);
        request->graded.check(*request);
    });
    return {options, [request] { return run_map_of(*request, LiftKind(*request)); }};
}

}  // namespace koebe::cli
