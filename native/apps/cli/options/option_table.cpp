#include "cli/options/option_table.h"

#include "cli/options/validators.h"
#include "core/page.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace koebe::cli {
namespace {

constexpr OptionRow all_rows[] = {
#include "option_rows.inc"
};

/// The parts of a text between separators.
std::vector<std::string> parted(std::string_view text, char mark)
{
    std::vector<std::string> parts;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(mark), text.size());
        parts.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return parts;
}

CLI::Option* finished(CLI::Option* option, const OptionRow& row)
{
    if (row.kind == "vertex") option->description(std::string(row.does) + " (from 0)");
    if (row.kind == "loop") option->description(std::string(row.does) + "\nVERTEX: the loop of this vertex (from 0)");
    if (!row.unit.empty()) option->type_name(std::string(row.unit));
    if (!row.with.empty()) option->group("With " + std::string(row.with));
    return option;
}

/// Parses the loops of "0-2" or "3". @return whether the word is one or two whole numbers
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

bool OptionRow::is_of(std::string_view map) const { return std::ranges::count(parted(maps, ' '), map) > 0; }

std::string OptionRow::flag() const
{
    std::string flag = "--" + std::string(name);
    std::ranges::replace(flag, '_', '-');
    return flag;
}

std::vector<std::string> OptionRow::choices() const { return parted(words, '|'); }

std::span<const OptionRow> option_rows() { return all_rows; }

const OptionRow* find_row(std::string_view map, std::string_view name)
{
    const auto is_it = [&](const OptionRow& row) { return row.name == name && row.is_of(map); };
    const auto found = std::ranges::find_if(all_rows, is_it);
    return found == std::end(all_rows) ? nullptr : found;
}

CLI::Option* add_value(CLI::App& app, const OptionRow& row, double& value)
{
    CLI::Option* const option = app.add_option(row.flag(), value, std::string(row.does));
    return finished(option->check(number_in(row.range))->capture_default_str(), row);
}

CLI::Option* add_value(CLI::App& app, const OptionRow& row, std::optional<double>& value)
{
    CLI::Option* const option = app.add_option(row.flag(), value, std::string(row.does));
    return finished(option->check(number_in(row.range)), row);
}

CLI::Option* add_value(CLI::App& app, const OptionRow& row, int& value)
{
    CLI::Option* const option = app.add_option(row.flag(), value, std::string(row.does));
    constexpr double largest = std::numeric_limits<int>::max();
    option->check(whole_number(static_cast<int>(std::max(row.range.min, 0.0)),
                               static_cast<int>(std::min(row.range.max, largest))));
    if (row.kind != "vertex") option->capture_default_str();
    return finished(option, row);
}

CLI::Option* add_value(CLI::App& app, const OptionRow& row, bool& value)
{
    return finished(app.add_flag(row.flag(), value, std::string(row.does)), row);
}

CLI::Option* add_value(CLI::App& app, const OptionRow& row, std::string& value)
{
    CLI::Option* const option = app.add_option(row.flag(), value, std::string(row.does));
    if (row.kind == "file") return finished(option, row);
    const auto check = [](const std::string& name) { return page_named(name) ? std::string() : page_help(name); };
    return finished(option->check(CLI::Validator(check, "", "page"))->capture_default_str(), row);
}

CLI::Option* add_choice(CLI::App& app, const OptionRow& row, int chosen, const std::function<void(int)>& set)
{
    const std::vector<std::string> words = row.choices();
    const auto take = [words, set](const std::string& word) {
        set(static_cast<int>(std::ranges::find(words, word) - words.begin()));
    };
    CLI::Option* const option = app.add_option_function<std::string>(row.flag(), take, std::string(row.does));
    return finished(option->check(CLI::IsMember(words))->default_str(words.at(static_cast<std::size_t>(chosen))), row);
}

CLI::Option* add_outer_loop(CLI::App& app, const OptionRow& row, UniformizeOptions& options)
{
    const std::vector<std::string> words = row.choices();
    const auto take = [words, &options](const std::string& word) {
        const auto known = std::ranges::find(words, word);
        options.outer = static_cast<OuterLoop>(known - words.begin());  // the last choice is a vertex
        options.outer_vertex = known == words.end() ? std::stoi(word) : -1;
    };
    CLI::Option* const option = app.add_option_function<std::string>(row.flag(), take, std::string(row.does));
    return finished(option->check(outer_loop_choice(words))->default_str(words.front()), row);
}

CLI::Option* add_steps(CLI::App& app, const OptionRow& row, Sweep& steps)
{
    const auto take = [&steps](const std::vector<std::string>& words) {
        steps.assign(words.size(), {});
        for (std::size_t k = 0; k < words.size(); ++k) parse_step(words[k], steps[k]);
    };
    CLI::Option* const option =
        app.add_option_function<std::vector<std::string>>(row.flag(), take, std::string(row.does));
    return finished(option->delimiter(',')->check(CLI::Validator(check_step, "", "step")), row);
}

std::vector<std::string> words_of(const Sweep& steps)
{
    std::vector<std::string> words;
    for (const OpenedLoops& loops : steps) {
        std::string& word = words.emplace_back();
        for (const int loop : loops) word += (word.empty() ? "" : "-") + std::to_string(loop);
    }
    return words;
}

}  // namespace koebe::cli
