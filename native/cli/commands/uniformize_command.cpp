// koebe uniformize IN OUT
#include "cli/commands/cut_map_command.h"
#include "cli/commands/map_run.h"
#include "cli/commands/subcommand.h"
#include "cli/files/weights_file.h"
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
    std::string importance;
    bool ends_with_input = false;
};

}  // namespace

Subcommand add_uniformize(CLI::App& app)
{
    auto request = std::make_shared<UniformizeRequest>();
    CLI::App* options = app.add_subcommand("uniformize", "map a surface with holes to a circle domain");
    add_mesh_arguments(*options, *request);
    add_uniformize_options(*options, request->options, request->cut);
    const OptionRow& importance = *find_row("uniformize", "importance");
    options->add_option(importance.flag(), request->importance, std::string(importance.does))->type_name("FILE");
    add_report_options(*options, *request);
    options->add_flag(end_with_input_flag, request->ends_with_input)->group("");
    options->callback([options, request] {
        check_map_files(*request);
        check_uniformize_options(*options, request->options, request->cut);
        if (!request->importance.empty() && request->options.balance == Balance::none)
            throw CLI::ValidationError("--importance", "needs --balance area");
        if (!request->importance.empty())
            require_different_files(map_files(*request), {request->input, request->importance}, !request->quiet);
        request->entries["options"] = uniformize_report(request->options, request->cut);
        if (!request->importance.empty()) request->entries["options"]["importance"] = true;
    });
    return {options, [request] {
                if (request->ends_with_input) end_with_input();
                if (!request->importance.empty())
                    request->options.importance = read_weights(request->importance, "an importance");
                if (request->cut) return run_cut_map(*request);
                return run_map(*request, [&](const auto& vertices, const auto& triangles, ExecutionContext& context) {
                    require_schedule_of_loops(triangles, static_cast<Index>(vertices.rows()), request->options);
                    return uniformize(vertices, triangles, request->options, context);
                });
            }};
}

}  // namespace koebe::cli
