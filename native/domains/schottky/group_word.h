// Words in the generators of handles, which generate a group.
#pragma once

#include "schottky/linear_fractional.h"

#include <vector>

namespace koebe {

/// Generator j is j + 1, its inverse -(j + 1); the last letter is applied first. No letter stands beside its inverse.
/// The group is free, so each element has one word.
using GroupWord = std::vector<int>;

/// Appends a letter, which is not 0.
void append_letter(GroupWord& word, int letter);
GroupWord product(GroupWord left, const GroupWord& right);
GroupWord inverse_of(GroupWord word);

Complex applied(const GroupWord& word, const std::vector<LinearFractional>& generators, Complex z);
Circle applied(const GroupWord& word, const std::vector<LinearFractional>& generators, Circle circle);

}  // namespace koebe
