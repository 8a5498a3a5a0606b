// Checks of option values, with messages for people.
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace koebe::cli {

/// A whole number from `least` on that a 32-bit int can hold.
CLI::Validator whole_number(int least);

/// A finite number above zero.
CLI::Validator positive_number();

/// A finite number between bounds.
/// @param above, below whether the bounds themselves are left out
CLI::Validator number_between(double least, double most, bool above, bool below);

/// One of the words or a vertex, counted from 0.
CLI::Validator outer_loop_choice(std::vector<std::string> words);

}  // namespace koebe::cli
