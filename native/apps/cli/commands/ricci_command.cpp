// koebe ricci IN OUT
#include "cli/commands/map_run.h"
#include "cli/commands/subcommand.h"
#include "cli/commands/uniformize_kind.h"
#include "cli/options/option_table.h"

#include "baselines/ricci_uniformize.h"

#include <memory>
#include <string>

namespace koebe::cli {
namespace {

struct RicciRequest : MapRequest {
    std::string packing = "inversive", target = "inscribed", triangulation = "delaunay";
};

RicciOptions ricci_options(const RicciRequest& request, const UniformizeOptions& chosen)
{
    return {.common = chosen,
            .packing = request.packing == "acute" ? Packing::acute : Packing::inversive,
            .target = request.target == "inscribed" ? BoundaryTarget::inscribed : BoundaryTarget::proportional,
            .delaunay = request.triangulation == "delaunay"};
}

}  // namespace

Subcommand add_ricci(CLI::App& app)
{
    auto request = std::make_shared<RicciRequest>();
    request->entries = {{"method", "ricci"}, {"engine", "circle_packing"}};
    CLI::App* options = app.add_subcommand("ricci", "as uniformize, but by the discrete Ricci flow, for comparison");
    add_mesh_arguments(*options, *request);
    // The flow's own choices, which no other map has.
    options
        ->add_option("--packing", request->packing,
                     "inversive: circles may be apart; acute: circles intersect, and the metric is approximate")
        ->check(CLI::IsMember({"inversive", "acute"}))
        ->capture_default_str();
    options
        ->add_option("--target", request->target,
                     "curvature of a loop's edges, inscribed: as chords of a circle, proportional: by length")
        ->check(CLI::IsMember({"inscribed", "proportional"}))
        ->capture_default_str();
    options
        ->add_option("--triangulation", request->triangulation,
                     "delaunay: edges are flipped on the surface first; given: the edges of the file")
        ->check(CLI::IsMember({"delaunay", "given"}))
        ->capture_default_str();
    add_options(*options, "ricci", request->options);
    add_options(*options, "ricci", request->of_files);
    add_report_options(*options, *request);
    // They stand in the report beside the options of uniformize.
    options->callback([request] {
        check_map_files(*request);
        report_options(*request, "ricci", request->options);
        request->entries["options"].update(
            {{"packing", request->packing}, {"target", request->target}, {"triangulation", request->triangulation}});
    });
    return {options, [request] {
                const auto map = [&](const auto& vertices, const auto& triangles, const auto& chosen,
                                     ExecutionContext& context) {
                    return ricci_uniformize(vertices, triangles, ricci_options(*request, chosen), context);
                };
                return run_map_of(*request, UniformizeKind(*request, map));
            }};
}

}  // namespace koebe::cli
