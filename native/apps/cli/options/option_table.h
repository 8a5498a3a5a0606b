// Makes flags from the table of options (options/options.json), and reports their values.
#pragma once

#include "cli/options/validators.h"
#include "core/types.h"
#include "each_option.h"
#include "iteration/sweep_order.h"
#include "pipeline/options.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace koebe::cli {

/// A row of the table, with the columns that the command needs.
struct OptionRow {
    std::string_view name, maps, does, kind, unit, words, with;
    NumberRange range;

    bool is_of(std::string_view map) const;
    std::string flag() const;  ///< "--max-sweeps"
    std::vector<std::string> choices() const;
};

std::span<const OptionRow> option_rows();

/// @return null if the map does not have this option
const OptionRow* find_row(std::string_view map, std::string_view name);

CLI::Option* add_value(CLI::App& app, const OptionRow& row, double& value);
CLI::Option* add_value(CLI::App& app, const OptionRow& row, std::optional<double>& value);
CLI::Option* add_value(CLI::App& app, const OptionRow& row, int& value);
CLI::Option* add_value(CLI::App& app, const OptionRow& row, bool& value);
/// Adds the name of a page (core/page.h), or of a file.
CLI::Option* add_value(CLI::App& app, const OptionRow& row, std::string& value);
/// Adds a choice among words; set() gets the number of the chosen word.
CLI::Option* add_choice(CLI::App& app, const OptionRow& row, int chosen, const std::function<void(int)>& set);
CLI::Option* add_outer_loop(CLI::App& app, const OptionRow& row, UniformizeOptions& options);
CLI::Option* add_steps(CLI::App& app, const OptionRow& row, Sweep& steps);

/// Adds flags for a map's options; each sets its field. Lists have no flags, except steps.
template <typename Options>
void add_options(CLI::App& app, std::string_view map, Options& options)
{
    each_option<Options>([&]<typename Field, typename Owner>(const char* name, Field Owner::*member) {
        const OptionRow* const row = find_row(map, name);
        if (row == nullptr) return;
        Owner& owner = options;
        Field& field = owner.*member;
        if constexpr (std::is_same_v<Field, OuterLoop>)
            add_outer_loop(app, *row, owner);
        else if constexpr (std::is_enum_v<Field>)
            add_choice(app, *row, static_cast<int>(field), [&field](int k) { field = static_cast<Field>(k); });
        else if constexpr (std::is_same_v<Field, Sweep>)
            add_steps(app, *row, field);
        else if constexpr (std::is_arithmetic_v<Field> || std::is_same_v<Field, std::optional<double>> ||
                           std::is_same_v<Field, std::string>)
            add_value(app, *row, field);
    });
}

/// Steps as written: "0-2" for loops 0 and 2, "3" for loop 3 alone.
std::vector<std::string> words_of(const Sweep& steps);

/// A map's options as a report has them: choices by their words, null for vertex -1. Without the number of threads and
/// the set of UVs, on which no map depends, and without lists except steps.
template <typename Options>
nlohmann::ordered_json option_report(std::string_view map, const Options& options)
{
    nlohmann::ordered_json report = nlohmann::ordered_json::object();
    each_option<Options>([&]<typename Field, typename Owner>(const std::string& name, Field Owner::*member) {
        const OptionRow* const row = find_row(map, name);
        if (row == nullptr || name == "threads" || name == "uv_channel") return;
        const Owner& owner = options;
        const Field& field = owner.*member;
        // A vertex in place of a word: the outer loop through it.
        if constexpr (std::is_same_v<Field, OuterLoop>) {
            if (field == OuterLoop::vertex)
                report[name] = owner.outer_vertex;
            else
                report[name] = row->choices().at(static_cast<std::size_t>(field));
        } else if constexpr (std::is_enum_v<Field>) {
            report[name] = row->choices().at(static_cast<std::size_t>(field));
        } else if constexpr (std::is_same_v<Field, Sweep>) {
            report[name] = words_of(field);
        } else if constexpr (std::is_same_v<Field, std::optional<double>>) {
            report[name] = field ? nlohmann::ordered_json(*field) : nullptr;
            // The number, or null where -1 stands for no vertex.
        } else if constexpr (std::is_arithmetic_v<Field> || std::is_same_v<Field, std::string>) {
            report[name] = field;
            if constexpr (std::is_arithmetic_v<Field>)
                if (row->kind == "vertex" && field == Field(-1)) report[name] = nullptr;
        }
    });
    return report;
}

}  // namespace koebe::cli
