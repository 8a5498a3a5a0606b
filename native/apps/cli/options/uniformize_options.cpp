#include "cli/options/uniformize_options.h"

#include "cli/options/option_table.h"
#include "cli/options/wrong_usage.h"
#include "core/errors.h"
#include "iteration/koebe_mesh.h"
#include "mesh/topology.h"

#include <string>

namespace koebe::cli {
namespace {

constexpr const char* uniformize_map = "uniformize";

}  // namespace

void add_uniformize_options(CLI::App& app, UniformizeOptions& options, bool& cut)
{
    add_options(app, uniformize_map, options);
    add_value(app, *find_row(uniformize_map, "cut"), cut);
    add_options(app, uniformize_map, options.mesh);
}

void check_uniformize_options(const CLI::App& app, const UniformizeOptions& options, bool cut)
{
    const KoebeMeshOptions& mesh = options.mesh;
    each_option<KoebeMeshOptions>([&](const char* name, auto) {
        const OptionRow* const row = find_row(uniformize_map, name);
        if (row != nullptr && options.engine != Engine::mesh && app.count(row->flag()) > 0)
            throw CLI::ValidationError(row->flag(), "needs --engine mesh");
    });
    if (mesh.partners == Partners::changing && options.method != Method::gk)
        throw CLI::ValidationError("--partners", "changing needs --method gk");
    if (mesh.partners == Partners::changing && !mesh.schedule.empty())
        throw CLI::ValidationError("--partners", "changing excludes --schedule");
    if (mesh.metric == KoebeMeshOptions::Metric::reflected_last && options.method == Method::ck)
        throw CLI::ValidationError("--metric", "reflected-last is not for --method ck");
    if (mesh.annulus == AnnulusBackend::yamabe && mesh.metric == KoebeMeshOptions::Metric::first)
        throw CLI::ValidationError("--annulus", "yamabe needs --metric planar or reflected");
    if (cut && !mesh.schedule.empty())
        throw CLI::ValidationError("--cut", "excludes --schedule: the cuts decide which loops there are");
    check_center(options);
}

void check_center(const UniformizeOptions& options)
{
    if (options.center >= 0 && options.balance != Balance::none)
        throw CLI::ValidationError("--center", "excludes --balance: both choose the centre of the disk");
}

nlohmann::ordered_json uniformize_report(const UniformizeOptions& options, bool cut)
{
    nlohmann::ordered_json report = option_report(uniformize_map, options);
    if (cut) report["cut"] = true;
    if (options.engine == Engine::mesh) report.update(option_report(uniformize_map, options.mesh));
    return report;
}

void require_schedule_of_loops(const Triangles& triangles, Index vertex_count, const UniformizeOptions& options)
{
    if (options.mesh.schedule.empty()) return;
    const std::size_t loop_count = analyze_surface(triangles, vertex_count).loops.size();
    if (loop_count == 0) return;  // a closed surface gets another error
    try {
        require_possible(options.mesh, static_cast<int>(loop_count), options.method);
    } catch (const InputError& error) {
        throw WrongUsage(std::string("--schedule: ") + error.what());
    }
}

}  // namespace koebe::cli
