// koebe schottky IN OUT
#include "cli/commands/corner_map.h"
#include "cli/commands/subcommand.h"
#include "cli/options/option_table.h"
#include "cli/process/end_with_input.h"

#include "core/counted.h"
#include "report/schottky_json.h"
#include "report/schottky_svg.h"
#include "schottky/schottky_map.h"

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
    auto kind = corner_map_kind<SchottkyResult, SchottkyOptions>(request, request.schottky, schottky_map);
    kind.draw = [](const MeshInput&, const SchottkyResult& result) { return schottky_svg(result); };
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
    add_mesh_arguments(*options, *request, "surface with one handle or more",
                       "texture coordinates of corners in [0, 1]^2");
    add_options(*options, "schottky", request->schottky);
    add_report_options(*options, *request, "write a picture there: the faces, and the circles of the copies");
    options->add_flag(end_with_input_flag, request->ends_with_input)->group("");
    options->callback([request] {
        check_map_files(*request);
        request->entries["options"] = option_report("schottky", request->schottky);
    });
    return {options, [request] { return run_schottky(*request); }};
}

}  // namespace koebe::cli
