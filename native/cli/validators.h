// Checks of option values, with messages for people.
#pragma once

#include <CLI/CLI.hpp>

namespace koebe::cli {

/// A whole number from `least` on that a 32-bit int can hold.
CLI::Validator whole_number(int least);

/// A finite number above zero.
CLI::Validator positive_number();

/// auto, longest or a vertex, counted from 0.
CLI::Validator outer_loop_choice();

}  // namespace koebe::cli
