// A sub-command: its options, and the function that runs after parsing.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <functional>
#include <span>

namespace koebe::cli {

struct Subcommand {
    CLI::App* options;
    std::function<int()> run;  ///< returns an ExitCode; errors are thrown
    /// What the report has beside the map; after parsing with the `options`. Null: the command makes no map.
    const nlohmann::ordered_json* entries = nullptr;
};

// The sub-commands of the extras, where those are built.
#ifdef KOEBE_LABS
#define KOEBE_OF_LABS(...) __VA_ARGS__
#else
#define KOEBE_OF_LABS(...)
#endif
#ifdef KOEBE_MAKING
#define KOEBE_OF_MAKING(...) __VA_ARGS__
#else
#define KOEBE_OF_MAKING(...)
#endif

/// Calls X(name) for each sub-command, in the order of the help. `add_name` adds the sub-command.
#define KOEBE_SUBCOMMANDS(X)                                                                                           \
    X(uniformize)                                                                                                      \
    X(batch)                                                                                                           \
    X(fill)                                                                                                            \
    KOEBE_OF_LABS(X(module) X(planar) X(compare) X(transfer) X(fit))                                                   \
    KOEBE_OF_MAKING(X(lift))                                                                                           \
    X(ricci)                                                                                                           \
    X(parts)                                                                                                           \
    X(pack)                                                                                                            \
    KOEBE_OF_MAKING(X(flatten))                                                                                        \
    X(torus)                                                                                                           \
    X(ring)                                                                                                            \
    X(sphere)                                                                                                          \
    X(schottky)                                                                                                        \
    X(sequence)

#define KOEBE_DECLARE(name) Subcommand add_##name(CLI::App& app);
KOEBE_SUBCOMMANDS(KOEBE_DECLARE)
#undef KOEBE_DECLARE

using AddSubcommand = Subcommand (*)(CLI::App& app);

struct NamedSubcommand {
    const char* name;
    AddSubcommand add;
};

/// Parses, runs one of the sub-commands, and turns errors into one line and an exit code, as command().
int command_of(std::span<const NamedSubcommand> known, int argc, char** argv);

}  // namespace koebe::cli
