// Segments of the plane, divided where they meet.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

/// A segment, and how often it is run through from its lower end (by x, then y) to its upper one, less the times back.
struct CountedSegment {
    Complex lower, upper;
    int times = 0;
};

/// Divides segments until they share ends only, and joins those with the same ends; those that are run through as often
/// there as back go. So closed curves stay closed. Pairs are found by CGAL's sweep over boxes and tested by exact
/// predicates. Ends and crossings are rounded to a grid of 2^-36 of the largest coordinate, a segment is led through
/// the ends that are less than a step away, and where this has made new crossings, these are divided in turn: iterated
/// snap rounding [Halperin, Packer 2002].
/// @param segments finite; ends in any order
/// @throws InputError over a million crossings, or rounding does not come to an end
std::vector<CountedSegment> divided_segments(std::vector<CountedSegment> segments);

}  // namespace koebe
