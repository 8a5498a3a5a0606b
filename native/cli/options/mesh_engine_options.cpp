#include "cli/options/mesh_engine_options.h"

#include "cli/options/wrong_usage.h"
#include "core/errors.h"
#include "iteration/koebe_mesh.h"
#include "mesh/topology.h"

#include <algorithm>
#include <charconv>

namespace koebe::cli {
namespace {

constexpr const char* mesh_engine_options[] = {"--partners", "--schedule", "--metric", "--annulus"};

/// The loops of "0-2" or "3". @return whether the word is one or two whole numbers
bool parse_step(const std::string& word, OpenedLoops& loops)
{
    loops.clear();
    const char* at = word.data();
    const char* end = at + word.size();
    while (loops.size() < 2) {
        int loop = 0;
        const auto [last, error] = std::from_chars(at, end, loop);
        if (error != std::errc{} || loop < 0 || *at == '-') return false;
        loops.push_back(loop);
        if (last == end) return true;
        if (*last != '-') return false;
        at = last + 1;
    }
    return false;
}

std::string check_step(const std::string& word)
{
    OpenedLoops loops;
    return parse_step(word, loops) ? std::string() : "must be steps like 0-2,1-3, or 0,2,1 with ck; got '" + word + "'";
}

}  // namespace

void add_mesh_engine_options(CLI::App& app, MeshEngineWords& words)
{
    const auto one_of = [](std::vector<std::string> choice) { return CLI::IsMember(std::move(choice)); };
    const std::string group = "The mesh engine, as in the paper";
    app.add_option("--partners", words.partners, "gk: a loop's partner in each sweep")
        ->check(one_of({"fixed", "changing"}))
        ->capture_default_str()
        ->group(group);
    app.add_option("--schedule", words.schedule, "the loops that each step opens, 0 the outer one: 0-2,1-3 or 0,2,1")
        ->delimiter(',')
        ->check(CLI::Validator(check_step, "", "step"))
        ->group(group);
    app.add_option("--metric", words.metric, "of each step: the surface's, or that of the last step's planar image")
        ->check(one_of({"first", "planar", "reflected"}))
        ->capture_default_str()
        ->group(group);
    app.add_option("--annulus", words.annulus, "by harmonic 1-forms or by the discrete Yamabe flow")
        ->check(one_of({"harmonic", "yamabe"}))
        ->capture_default_str()
        ->group(group);
}

void set_mesh_engine_options(const CLI::App& app, const MeshEngineWords& words, UniformizeOptions& options)
{
    if (options.engine != Engine::mesh)
        for (const char* name : mesh_engine_options)
            if (app.count(name) > 0) throw CLI::ValidationError(name, "is an option of --engine mesh");
    KoebeMeshOptions& mesh = options.mesh;
    mesh.partners = words.partners == "fixed" ? Partners::fixed : Partners::changing;
    mesh.metric = words.metric == "first"    ? KoebeMeshOptions::Metric::first
                  : words.metric == "planar" ? KoebeMeshOptions::Metric::planar
                                             : KoebeMeshOptions::Metric::reflected;
    mesh.annulus = words.annulus == "harmonic" ? AnnulusBackend::harmonic : AnnulusBackend::yamabe;
    for (const std::string& word : words.schedule) parse_step(word, mesh.schedule.emplace_back());
    if (mesh.partners == Partners::changing && options.method != Method::gk)
        throw CLI::ValidationError("--partners", "change with --method gk alone");
    if (mesh.partners == Partners::changing && !mesh.schedule.empty())
        throw CLI::ValidationError("--partners", "and --schedule exclude each other");
    if (mesh.annulus == AnnulusBackend::yamabe && mesh.metric == KoebeMeshOptions::Metric::first)
        throw CLI::ValidationError("--annulus", "yamabe needs --metric planar or reflected");
}

void require_schedule_of_loops(const Triangles& triangles, Index vertex_count, const UniformizeOptions& options)
{
    if (options.mesh.schedule.empty()) return;
    const std::size_t loop_count = analyze_surface(triangles, vertex_count).loops.size();
    if (loop_count == 0) return;  // closed: another error
    try {
        require_possible(options.mesh, static_cast<int>(loop_count), options.method);
    } catch (const InputError& error) {
        throw WrongUsage(std::string("--schedule: ") + error.what());
    }
}

}  // namespace koebe::cli
