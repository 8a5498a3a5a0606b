// The longest common sequence of two lists.
#pragma once

#include "core/types.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace koebe {

/// Places in both lists of the longest sequence of names that both have in this order (Hunt and Szymanski 1977): its
/// cost is about that of the pairs of equal names. Where several are longest, it leaves out names of a before those of
/// b.
std::vector<std::pair<std::size_t, std::size_t>> common_sequence(const std::vector<Index>& a,
                                                                 const std::vector<Index>& b);

}  // namespace koebe
