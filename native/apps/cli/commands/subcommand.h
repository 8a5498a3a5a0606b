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

/// A map that `koebe batch` makes: its name there, the command that makes it, and the words by which the add-on's
/// batch.py makes it; null: it does not.
struct BatchDomain {
    const char* name;
    AddSubcommand add;
    const char* of_blender;
    bool makes_pattern = false;  ///< a drawing in place of a mesh
};

inline constexpr BatchDomain batch_domains[]{{"disk", add_uniformize, ""},
                                             {"torus", add_torus, "--domain=torus"},
                                             {"ring", add_ring, "--domain=ring"},
                                             {"sphere", add_sphere, "--domain=sphere"},
                                             {"schottky", add_schottky, "--domain=schottky"},
                                             {"parts", add_parts, "--parts"},
                                             {"pack", add_pack, nullptr},
                                             KOEBE_OF_MAKING({"flatten", add_flatten, nullptr, true})};

/// Parses, runs one of the sub-commands, and turns errors into one line and an exit code, as command().
int command_of(std::span<const NamedSubcommand> known, int argc, char** argv);

}  // namespace koebe::cli
