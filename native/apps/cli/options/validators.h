// Checks of option values, with messages for people.
#pragma once

#include <CLI/CLI.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace koebe::cli {

/// A whole number from `least` to `most`.
CLI::Validator whole_number(int least, int most = std::numeric_limits<int>::max());

/// From `min` to `max`, above `above`, below `below`: the keys in the table of options, sorted.
struct NumberRange {
    double above = -INFINITY, below = INFINITY, max = INFINITY, min = -INFINITY;
};

/// A finite number in a range.
CLI::Validator number_in(const NumberRange& range);

/// One of the words, or a vertex number counted from 0.
CLI::Validator outer_loop_choice(std::vector<std::string> words);

}  // namespace koebe::cli
