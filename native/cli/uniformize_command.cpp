// koebe uniformize IN OUT
#include "cli/map_command.h"
#include "cli/mesh_engine_options.h"
#include "cli/subcommand.h"

#include "pipeline/uniformize.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace koebe::cli {
namespace {

struct Request : MapRequest {
    std::string method = "gk", engine = "condensed", balance = "none";
    MeshEngineWords mesh;
};

void add_options(CLI::App& app, Request& request)
{
    const auto one_of = [](std::vector<std::string> words) { return CLI::IsMember(std::move(words)); };

    add_mesh_arguments(app, request);
    app.add_option("--method", request.method,
                   "gk: generalized Koebe iteration, ck: conventional, against-outer: a hole at a time")
        ->check(one_of({"gk", "ck", "against-outer"}))
        ->capture_default_str();
    app.add_option("--engine", request.engine, "condensed: fast, mesh: as in the paper")
        ->check(one_of({"condensed", "mesh"}))
        ->capture_default_str();
    app.add_option("--balance", request.balance, "area: the Moebius map of least area distortion")
        ->check(one_of({"none", "area"}))
        ->capture_default_str();
    app.add_flag("--polish", request.options.polish, "lower the angle error, circles unchanged; slower");
    add_map_options(app, request);
    add_mesh_engine_options(app, request.mesh);
}

/// The words that the validators let through, as options.
void set_choices(const CLI::App& app, Request& request)
{
    UniformizeOptions& options = request.options;
    options.method = request.method == "gk" ? Method::gk : request.method == "ck" ? Method::ck : Method::against_outer;
    options.engine = request.engine == "condensed" ? Engine::condensed : Engine::mesh;
    options.balance = request.balance == "none" ? Balance::none : Balance::area;
    set_mesh_engine_options(app, request.mesh, options);
    if (options.center >= 0 && options.balance != Balance::none)
        throw CLI::ValidationError("--center", "excludes --balance: both choose the automorphism of the disk");
}

}  // namespace

Subcommand add_uniformize(CLI::App& app)
{
    auto request = std::make_shared<Request>();
    CLI::App* options = app.add_subcommand("uniformize", "map a surface with holes to a circle domain");
    add_options(*options, *request);
    options->callback([options, request] {
        check_map_options(*request);
        set_choices(*options, *request);
    });
    return {options, [request] {
                return run_map(*request, [&](const auto& vertices, const auto& triangles, ExecutionContext& context) {
                    require_schedule_of_loops(triangles, static_cast<Index>(vertices.rows()), request->options);
                    return uniformize(vertices, triangles, request->options, context);
                });
            }};
}

}  // namespace koebe::cli
