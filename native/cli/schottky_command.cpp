// koebe schottky IN OUT
#include "cli/end_with_input.h"
#include "cli/map_run.h"
#include "cli/mapping_options.h"
#include "cli/subcommand.h"
#include "cli/validators.h"

#include "core/counted.h"
#include "domains/schottky_map.h"
#include "io/corner_uvs.h"
#include "report/schottky_json.h"
#include "report/schottky_svg.h"

#include <map>
#include <memory>
#include <string>
#include <utility>

namespace koebe::cli {
namespace {

struct SchottkyRequest : MapRequest {
    SchottkyOptions schottky;
    bool ends_with_input = false;
};

int run_schottky(const SchottkyRequest& request)
{
    if (request.ends_with_input) end_with_input();
    MapKind<SchottkyResult> kind = corner_map<SchottkyResult, SchottkyOptions>(request, request.schottky, schottky_map);
    kind.draw = [](const MeshInput&, const SchottkyResult& result) { return schottky_svg(result); };
    kind.report = [](const SchottkyResult& result) { return to_json(result); };
    kind.first_words = [](const SchottkyResult& result) {
        return counted(result.handles.size(), "handle") + ", " + counted(result.holes.size(), "loop") + ", " +
               counted(static_cast<std::size_t>(result.sweeps), "sweep");
    };
    return run_map_of(request, kind);
}

}  // namespace

Subcommand add_schottky(CLI::App& app)
{
    auto request = std::make_shared<SchottkyRequest>();
    CLI::App* options =
        app.add_subcommand("schottky", "map a surface with handles into the disk, cut open, its cuts Moebius maps "
                                       "apart and its holes round");
    options->add_option("IN", request->input, "surface with one handle or more: OBJ, OFF, PLY or STL")->required();
    options
        ->add_option(
            "OUT", request->output,
            "OBJ or PLY to write: the same vertices and faces, with texture coordinates of corners in [0, 1]^2")
        ->required();
    const std::map<std::string, SchottkyNormalization> names{
        {to_string(SchottkyNormalization::area), SchottkyNormalization::area},
        {to_string(SchottkyNormalization::circles), SchottkyNormalization::circles}};
    options
        ->add_option("--normalization", request->schottky.normalization,
                     "with holes: the least area distortion, or near it room for equally large circles of handles")
        ->transform(CLI::Transformer(names))
        ->type_name("area|circles")
        ->default_str("area");
    options
        ->add_option("--tolerance", request->schottky.tolerance,
                     "stop when the disks that fill the loops change by less in a sweep, relative")
        ->check(positive_number())
        ->type_name("NUMBER")
        ->capture_default_str();
    options->add_option("--max-sweeps", request->schottky.max_sweeps, "then stop, not converged")
        ->check(whole_number(1))
        ->type_name("N")
        ->capture_default_str();
    add_most_lost(*options, request->schottky.most_lost);
    options->add_option("--json", request->json, "write the report there")->type_name("FILE");
    options->add_option("--svg", request->svg, "write a picture there: the faces, and the circles of the copies")
        ->type_name("FILE");
    options->add_flag("--quiet", request->quiet, "no progress and no result line");
    options->add_flag(end_with_input_flag, request->ends_with_input)->group("");
    options->callback([request] {
        check_map_files(*request);
        request->entries["options"] = {{"normalization", to_string(request->schottky.normalization)},
                                       {"tolerance", request->schottky.tolerance},
                                       {"max_sweeps", request->schottky.max_sweeps},
                                       {"most_lost", request->schottky.most_lost}};
    });
    return {options, [request] { return run_schottky(*request); }};
}

}  // namespace koebe::cli
