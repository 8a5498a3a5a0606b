// Loops between which a capacity is.
#pragma once

#include <vector>

namespace koebe {

/// Loops held at 0 and loops held at 1. No flux runs through the other loops. Loops are numbered by their lowest
/// vertices, as Surface::loops.
struct Condenser {
    std::vector<int> at_zero, at_one;
};

}  // namespace koebe
