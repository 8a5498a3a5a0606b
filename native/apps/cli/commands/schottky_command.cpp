// koebe schottky IN OUT
#include "cli/commands/corner_map.h"

#include "core/counted.h"
#include "report/schottky_json.h"
#include "report/schottky_svg.h"
#include "schottky/schottky_map.h"

namespace koebe::cli {
namespace {

int run_schottky(const CornerMapRequest<SchottkyOptions>& request)
{
    auto kind = corner_map_kind<SchottkyResult, SchottkyOptions>(request, request.chosen, schottky_map);
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
    return add_corner_map<SchottkyOptions>(
        app,
        {"schottky",
         "cut a surface with handles open and map it into the disk: Moebius maps join the cuts, holes are round",
         "surface with one handle or more", "write a picture there: the faces, and the circles of the copies"},
        run_schottky);
}

}  // namespace koebe::cli
