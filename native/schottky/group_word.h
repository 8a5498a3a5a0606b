// Elements of the group that the generators of handles generate.
#pragma once

#include "schottky/linear_fractional.h"

#include <vector>

namespace koebe {

/// Generators j as j + 1, their inverses as -(j + 1); the last one is applied first. No letter stands beside its
/// inverse, so that each element has one word: the group is free.
using GroupWord = std::vector<int>;

/// 0 is no letter.
void append_letter(GroupWord& word, int letter);
GroupWord product(GroupWord left, const GroupWord& right);
GroupWord inverse_of(GroupWord word);

Complex applied(const GroupWord& word, const std::vector<LinearFractional>& generators, Complex z);
Circle applied(const GroupWord& word, const std::vector<LinearFractional>& generators, Circle circle);

}  // namespace koebe
