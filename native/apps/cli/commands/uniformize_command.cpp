// koebe uniformize IN OUT
#include "cli/commands/cut_map_command.h"
#include "cli/commands/map_run.h"
#include "cli/commands/subcommand.h"
#include "cli/commands/weights_option.h"
#include "cli/options/option_table.h"
#include "cli/options/uniformize_options.h"
#include "cli/process/end_with_input.h"

#include "pipeline/uniformize.h"

#include <memory>
#include <utility>

namespace koebe::cli {
namespace {

struct UniformizeRequest : MapRequest {
    bool cut = false;
    WeightsOption importance;
    bool ends_with_input = false;
};

}  // namespace

Subcommand add_uniformize(CLI::App& app)
{
    auto request = std::make_shared<UniformizeRequest>();
    CLI::App* options = app.add_subcommand("uniformize", "map a surface with holes to a circle domain");
    add_mesh_arguments(*options, *request);
    add_uniformize_options(*options, request->options, request->cut);
    add_options(*options, "uniformize", request->of_files);
    request->importance.add(*options, "uniformize", "importance");
    add_report_options(*options, *request);
    options->add_flag(end_with_input_flag, request->ends_with_input)->group("");
    options->callback([options, request] {
        check_map_files(*request);
        check_uniformize_options(*options, request->options, request->cut);
        if (request->importance.is_given() && request->options.balance == Balance::none &&
            !(request->options.even > 0.0))
            throw CLI::ValidationError("--importance", "needs --balance area, or --even above 0");
        request->entries["options"] = uniformize_report(request->options, request->cut);
        request->entries["options"].update(option_report("uniformize", request->of_files));
        request->importance.check(*request);
    });
    return {options,
            [request] {
                if (request->ends_with_input) end_with_input();
                request->options.importance = request->importance.read("an importance");
                if (request->cut) return run_cut_map(*request);
                return run_map(*request, [](const auto& vertices, const auto& triangles, const auto& chosen,
                                            ExecutionContext& context) {
                    require_schedule_of_loops(triangles, static_cast<Index>(vertices.rows()), chosen);
                    return uniformize(vertices, triangles, chosen, context);
                });
            },
            &request->entries};
}

}  // namespace koebe::cli
