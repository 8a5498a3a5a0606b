// A sub-command: its options and what runs after they are parsed.
#pragma once

#include <CLI/CLI.hpp>

#include <functional>

namespace koebe::cli {

struct Subcommand {
    CLI::App* options;
    std::function<int()> run;  ///< returns an ExitCode; errors are thrown
};

Subcommand add_batch(CLI::App& app);
Subcommand add_compare(CLI::App& app);
Subcommand add_fill(CLI::App& app);
Subcommand add_module(CLI::App& app);
Subcommand add_parts(CLI::App& app);
Subcommand add_ricci(CLI::App& app);
Subcommand add_ring(CLI::App& app);
Subcommand add_schottky(CLI::App& app);
Subcommand add_sequence(CLI::App& app);
Subcommand add_sphere(CLI::App& app);
Subcommand add_torus(CLI::App& app);
Subcommand add_transfer(CLI::App& app);
Subcommand add_uniformize(CLI::App& app);

}  // namespace koebe::cli
