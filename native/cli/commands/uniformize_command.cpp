// koebe uniformize IN OUT
#include "cli/commands/cut_map_command.h"
#include "cli/commands/map_run.h"
#include "cli/commands/subcommand.h"
#include "cli/files/importance_file.h"
#include "cli/options/uniformize_options.h"
#include "cli/process/end_with_input.h"

#include "pipeline/uniformize.h"

#include <memory>
#include <utility>

namespace koebe::cli {
namespace {

struct Request : MapRequest {
    UniformizeWords words;
    std::string importance;
    bool ends_with_input = false;
};

}  // namespace

Subcommand add_uniformize(CLI::App& app)
{
    auto request = std::make_shared<Request>();
    CLI::App* options = app.add_subcommand("uniformize", "map a surface with holes to a circle domain");
    add_mesh_arguments(*options, *request);
    add_uniformize_options(*options, *request, request->words);
    options
        ->add_option("--importance", request->importance,
                     "with --balance area: a number from 0 to 1 for each vertex, 1 where there shall be most texels")
        ->type_name("FILE");
    add_report_options(*options, *request);
    options->add_flag(end_with_input_flag, request->ends_with_input)->group("");
    options->callback([options, request] {
        check_map_files(*request);
        set_uniformize_options(*options, request->words, *request);
        if (!request->importance.empty() && request->options.balance == Balance::none)
            throw CLI::ValidationError("--importance", "is of the balance: give --balance area too");
        if (!request->importance.empty())
            require_different_files(map_files(*request), {request->input, request->importance}, !request->quiet);
        request->entries["options"] = options_report(*request, request->words);
        if (!request->importance.empty()) request->entries["options"]["importance"] = true;
    });
    return {options, [request] {
                if (request->ends_with_input) end_with_input();
                if (!request->importance.empty()) request->options.importance = read_importance(request->importance);
                if (request->words.cut) return run_cut_map(*request);
                return run_map(*request, [&](const auto& vertices, const auto& triangles, ExecutionContext& context) {
                    require_schedule_of_loops(triangles, static_cast<Index>(vertices.rows()), request->options);
                    return uniformize(vertices, triangles, request->options, context);
                });
            }};
}

}  // namespace koebe::cli
