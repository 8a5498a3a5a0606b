// Circles inside the unit disk that meet each other or leave it.
#pragma once

#include "circles/circle.h"

#include <vector>

namespace koebe {

/// Whether circle k is finite, of positive radius, inside the unit disk and apart from the others.
/// @param circles the unit circle first @param margin its own radius counts so many times
bool is_apart(const std::vector<Circle>& circles, std::size_t k, double margin = 1.0);

/// Whether all are.
bool circles_apart(const std::vector<Circle>& circles);

/// Makes circles smaller that meet another or leave the disk, as those of loops of a few vertices do where less than an
/// edge is between them: r_k <= d_kj r_k / (r_k + r_j) for all j leaves every pair apart.
/// @return the loops of the circles it changed
std::vector<Index> shrink_crowded(std::vector<Circle>& circles);

}  // namespace koebe
