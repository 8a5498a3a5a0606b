// Correspondences of loops whose extremal maps may have a small dilatation.
#pragma once

#include "circles/circle.h"
#include "execution/execution.h"

#include <utility>
#include <vector>

namespace koebe {

/// A lower bound of the dilatation of all maps with a match of the loops, and the match: b's loop for each of a's.
using BoundedMatch = std::pair<double, std::vector<int>>;

/// Such a search would be too long.
[[noreturn]] void refuse_long_search();

/// The matches that keep the outer loops together and have a bound below the limit, least bound first. A map of
/// dilatation K extends by reflections to a map of the sphere of dilatation K. So no separation of two circles
/// (conformal_separation) changes by more than the factor K. Searched depth first.
/// @param a, b circle domains with equally many loops @throws InputError the search is too long; Cancelled
std::vector<BoundedMatch> bounded_matches(const std::vector<Circle>& a, const std::vector<Circle>& b, double limit,
                                          const ExecutionContext& context);

}  // namespace koebe
