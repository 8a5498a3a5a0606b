// The options of a map by the Koebe iteration: for one file or for many.
#pragma once

#include "cli/options/map_request.h"
#include "cli/options/mesh_engine_options.h"

#include <nlohmann/json.hpp>

#include <string>

namespace koebe::cli {

struct UniformizeWords {
    std::string method = "gk", engine = "condensed", balance = "none";
    MeshEngineWords mesh;
    bool cut = false;
};

/// --method, --engine, --balance, --polish, --cut, those of add_domain_options, and those of the mesh engine.
void add_uniformize_options(CLI::App& app, MapRequest& request, UniformizeWords& words);

/// Sets what the words mean.
/// @throws CLI::ValidationError options that exclude each other
void set_uniformize_options(const CLI::App& app, const UniformizeWords& words, MapRequest& request);

/// What a map depends on beside the mesh, for its report (domain_options_report, and the words).
nlohmann::ordered_json options_report(const MapRequest& request, const UniformizeWords& words);

}  // namespace koebe::cli
