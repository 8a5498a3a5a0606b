// What a program does to its surface: operations that keep a surface one, and such that break it.
#pragma once

#include "program.h"

namespace koebe::fuzz {

/// @param a, b any numbers: they pick faces and vertices modulo what there are @param amount how far, how much
struct EditChoice {
    int kind = 0;  ///< modulo edit_kind_count()
    std::size_t a = 0, b = 0;
    int amount = 0;  ///< -128 to 127
};

void edit(Soup& soup, const EditChoice& choice, const Limits& limits);

}  // namespace koebe::fuzz
