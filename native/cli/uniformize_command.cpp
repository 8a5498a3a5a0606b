// koebe uniformize IN OUT
#include "cli/cut_map_command.h"
#include "cli/end_with_input.h"
#include "cli/map_command.h"
#include "cli/subcommand.h"
#include "cli/uniformize_options.h"

#include "pipeline/uniformize.h"

#include <memory>
#include <utility>

namespace koebe::cli {
namespace {

struct Request : MapRequest {
    UniformizeWords words;
    bool cut = false;
    bool ends_with_input = false;
};

}  // namespace

Subcommand add_uniformize(CLI::App& app)
{
    auto request = std::make_shared<Request>();
    CLI::App* options = app.add_subcommand("uniformize", "map a surface with holes to a circle domain");
    add_mesh_arguments(*options, *request);
    add_uniformize_options(*options, *request, request->words);
    options->add_flag("--cut", request->cut,
                      "open, cut and split in the UVs what cannot be mapped as it is: any mesh, several pieces");
    add_report_options(*options, *request);
    options->add_flag(end_with_input_flag, request->ends_with_input)->group("");
    options->callback([options, request] {
        check_map_files(*request);
        set_uniformize_options(*options, request->words, *request);
        if (request->cut && !request->options.mesh.schedule.empty())
            throw CLI::ValidationError("--cut", "excludes --schedule: which loops there are follows from the cuts");
        request->entries["options"] = options_report(*request, request->words);
        if (request->cut) request->entries["options"]["cut"] = true;
    });
    return {options, [request] {
                if (request->ends_with_input) end_with_input();
                if (request->cut) return run_cut_map(*request);
                return run_map(*request, [&](const auto& vertices, const auto& triangles, ExecutionContext& context) {
                    require_schedule_of_loops(triangles, static_cast<Index>(vertices.rows()), request->options);
                    return uniformize(vertices, triangles, request->options, context);
                });
            }};
}

}  // namespace koebe::cli
