// The surfaces that a program starts from.
#pragma once

#include "program.h"

namespace koebe::fuzz {

struct BaseChoice {
    int kind = 0;              ///< modulo base_kind_count()
    std::size_t n = 1, m = 1;  ///< cells along two sides
    std::size_t holes = 0;
    std::uint64_t seed = 0;
    int shape = 0;  ///< how the points lie in space
};

Soup base_surface(const BaseChoice& choice);

}  // namespace koebe::fuzz
