#include "cli/options/uniformize_options.h"

#include <utility>
#include <vector>

namespace koebe::cli {

void add_uniformize_options(CLI::App& app, MapRequest& request, UniformizeWords& words)
{
    const auto one_of = [](std::vector<std::string> choice) { return CLI::IsMember(std::move(choice)); };

    app.add_option("--method", words.method,
                   "gk: generalized Koebe iteration, ck: conventional, against-outer: a hole at a time")
        ->check(one_of({"gk", "ck", "against-outer"}))
        ->capture_default_str();
    app.add_option("--engine", words.engine, "condensed: fast, mesh: as in the paper")
        ->check(one_of({"condensed", "mesh"}))
        ->capture_default_str();
    app.add_option("--balance", words.balance, "area: the Moebius map of least area distortion")
        ->check(one_of({"none", "area"}))
        ->capture_default_str();
    app.add_flag("--polish", request.options.polish, "lower the angle error, circles unchanged; slower");
    app.add_flag("--cut", words.cut,
                 "open, cut and split in the UVs what cannot be mapped as it is: any mesh, several pieces");
    add_domain_options(app, request);
    add_mesh_engine_options(app, words.mesh);
}

void set_uniformize_options(const CLI::App& app, const UniformizeWords& words, MapRequest& request)
{
    UniformizeOptions& options = request.options;
    options.method = words.method == "gk" ? Method::gk : words.method == "ck" ? Method::ck : Method::against_outer;
    options.engine = words.engine == "condensed" ? Engine::condensed : Engine::mesh;
    options.balance = words.balance == "none" ? Balance::none : Balance::area;
    set_outer_loop(request);
    set_mesh_engine_options(app, words.mesh, options);
    if (words.cut && !options.mesh.schedule.empty())
        throw CLI::ValidationError("--cut", "excludes --schedule: which loops there are follows from the cuts");
    if (options.center >= 0 && options.balance != Balance::none)
        throw CLI::ValidationError("--center", "excludes --balance: both choose the automorphism of the disk");
}

nlohmann::ordered_json options_report(const MapRequest& request, const UniformizeWords& words)
{
    nlohmann::ordered_json report{{"method", words.method}, {"engine", words.engine}};
    report.update(domain_options_report(request));
    report.update({{"balance", words.balance}, {"polish", request.options.polish}});
    if (words.cut) report["cut"] = true;
    if (request.options.engine == Engine::mesh)
        report.update({{"partners", words.mesh.partners},
                       {"schedule", words.mesh.schedule},
                       {"metric", words.mesh.metric},
                       {"annulus", words.mesh.annulus}});
    return report;
}

}  // namespace koebe::cli
