// koebe parts IN OUT
#include "cli/commands/corner_map.h"

#include "core/counted.h"
#include "parts/parts.h"
#include "report/parts_json.h"
#include "report/parts_svg.h"

#include <utility>

namespace koebe::cli {
namespace {

int run_parts(const CornerMapRequest<PartsOptions>& request)
{
    auto kind = piece_map_kind(request, request.chosen, parts_of, &PartsResult::parts);
    kind.draw = [](const MeshInput&, const PartsResult& result) {
        return parts_svg(result.uv, result.part, result.tiles);
    };
    kind.first_words = [](const PartsResult& result) {
        return counted(result.parts.size(), "part") + ", cuts " + formatted("%.2f", result.cut_length) +
               " times the root of the area, texel density within a factor " +
               formatted("%.3g", result.density_ratio_5_95);
    };
    return run_map_of(request, kind);
}

}  // namespace

Subcommand add_parts(CLI::App& app)
{
    return add_corner_map<PartsOptions>(app,
                                        {"parts", "cut any surface in its UVs into even disks and tubes", "any mesh",
                                         "write a picture of the parts there"},
                                        run_parts);
}

}  // namespace koebe::cli
