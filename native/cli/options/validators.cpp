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

CLI::Validator whole_number(int least)
{
    const auto check = [least](const std::string& word) -> std::string {
        int number = 0;
        if (parse(word, number) && number >= least) return {};
        return "must be a whole number from " + std::to_string(least) + " on; got '" + word + "'";
    };
    return {check, "", "whole_number"};
}

CLI::Validator positive_number() { return number_between(0.0, INFINITY, true, true); }

CLI::Validator number_between(double least, double most, bool above, bool below)
{
    const auto text = [](double bound) {
        std::ostringstream stream;
        stream << bound;
        return stream.str();
    };
    std::string range = (above ? "above " : "from ") + text(least);
    if (std::isfinite(most)) range += (below ? " to below " : " to ") + text(most);
    const auto check = [=](const std::string& word) -> std::string {
        double number = 0.0;
        if (parse(word, number) && std::isfinite(number) && (above ? number > least : number >= least) &&
            (below ? number < most : number <= most))
            return {};
        return "must be a finite number " + range + "; got '" + word + "'";
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
