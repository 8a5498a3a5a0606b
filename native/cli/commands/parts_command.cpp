// koebe parts IN OUT
#include "cli/commands/corner_map.h"
#include "cli/commands/subcommand.h"
#include "cli/options/option_table.h"

#include "core/counted.h"
#include "parts/parts.h"
#include "report/parts_json.h"
#include "report/parts_svg.h"

#include <memory>
#include <utility>

namespace koebe::cli {
namespace {

struct Request : MapRequest {
    PartsOptions parts;
};

int run(const Request& request)
{
    auto kind = corner_map_kind<PartsResult, PartsOptions>(request, request.parts, parts_of);
    kind.many_pieces = true;
    kind.compute = [compute = kind.compute](const MeshInput& input, ExecutionContext& context) {
        PartsResult result = compute(input, context);
        for (PartReport& part : result.parts) part.faces = filed_faces(input.triangulation, part.faces);
        return result;
    };
    kind.draw = [](const MeshInput&, const PartsResult& result) { return parts_svg(result.uv, result.part); };
    kind.first_words = [](const PartsResult& result) {
        return counted(result.parts.size(), "part") + ", cuts " + rounded("%.2f", result.cut_length) +
               " of the root of the area, texel density within " + rounded("%.3g", result.density_ratio_5_95);
    };
    return run_map_of(request, kind);
}

}  // namespace

Subcommand add_parts(CLI::App& app)
{
    auto request = std::make_shared<Request>();
    CLI::App* options = app.add_subcommand("parts", "cut any surface in its UVs into even disks and tubes");
    add_mesh_arguments(*options, *request, "any mesh", "texture coordinates of corners in [0, 1]^2");
    add_options(*options, "parts", request->parts);
    add_report_options(*options, *request, "write a picture of the parts there");
    options->callback([request] {
        check_map_files(*request);
        request->entries["options"] = option_report("parts", request->parts);
    });
    return {options, [request] { return run(*request); }};
}

}  // namespace koebe::cli
