// New programs out of old ones, record by record.
#pragma once

#include "program.h"
#include "random.h"

namespace koebe::fuzz {

/// Some changes of base surface, options and edits; edits are put in, dropped, swapped, repeated and changed.
std::vector<std::uint8_t> mutate(Bytes program, Random& random);

/// The base surface and options of one, edits of both.
std::vector<std::uint8_t> cross_over(Bytes first, Bytes second, Random& random);

/// A program out of nothing.
std::vector<std::uint8_t> random_program(Random& random);

}  // namespace koebe::fuzz
