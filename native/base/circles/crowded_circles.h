// Circles inside the unit disk that meet each other or leave it.
#pragma once

#include "circles/circle.h"

#include <vector>

namespace koebe {

/// Whether circle k is finite, of positive radius, inside the unit disk and apart from the other circles.
/// @param circles the unit circle first @param margin factor on the circle's radius in this test
bool is_apart(const std::vector<Circle>& circles, std::size_t k, double margin = 1.0);

/// Whether all circles are apart.
bool circles_apart(const std::vector<Circle>& circles);

/// Shrinks circles that meet another circle or leave the disk. Loops of few vertices that are less than an edge apart
/// get such circles. r_k <= d_kj r_k / (r_k + r_j) for all j keeps every pair apart.
/// @return the loops whose circles changed
std::vector<Index> shrink_crowded(std::vector<Circle>& circles);

}  // namespace koebe
