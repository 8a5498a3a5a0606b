#include "cli/options/validators.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <utility>

namespace koebe::cli {
namespace {

/// Whether the whole word is a number of this type.
template <typename Number>
bool parse(const std::string& word, Number& number)
{
    const char* end = word.data() + word.size();
    const auto [last, error] = std::from_chars(word.data(), end, number);
    return error == std::errc{} && last == end;
}

}  // namespace

CLI::Validator whole_number(int least, int most)
{
    const auto check = [least, most](const std::string& word) -> std::string {
        int number = 0;
        if (parse(word, number) && number >= least && number <= most) return {};
        const std::string until =
            most < std::numeric_limits<int>::max() ? " to " + std::to_string(most) : std::string(" on");
        return "must be a whole number from " + std::to_string(least) + until + "; got '" + word + "'";
    };
    return {check, "", "whole_number"};
}

CLI::Validator number_in(const NumberRange& range)
{
    std::ostringstream words;
    words << (std::isfinite(range.above) ? "above " : "from ") << std::max(range.above, range.min);
    if (std::isfinite(range.max)) words << " to " << range.max;
    if (std::isfinite(range.below)) words << " to below " << range.below;
    const auto check = [range, said = words.str()](const std::string& word) -> std::string {
        double number = 0.0;
        if (parse(word, number) && std::isfinite(number) && number > range.above && number >= range.min &&
            number <= range.max && number < range.below)
            return {};
        return "must be a finite number " + said + "; got '" + word + "'";
    };
    return {check, "", "number"};
}

CLI::Validator outer_loop_choice(std::vector<std::string> words)
{
    const auto check = [words = std::move(words)](const std::string& word) -> std::string {
        int vertex = 0;
        if (std::ranges::find(words, word) != words.end() || (parse(word, vertex) && vertex >= 0)) return {};
        std::string choice;
        for (const std::string& known : words) choice += known + ", ";
        return "must be " + choice + "or the number of a vertex, counted from 0; got '" + word + "'";
    };
    return {check, "", "outer_loop_choice"};
}

}  // namespace koebe::cli
