// Inputs to start from.
#pragma once

#include "targets.h"

#include <cstdint>
#include <string>
#include <vector>

namespace koebe::fuzz {

struct Seed {
    std::string name;
    std::vector<std::uint8_t> bytes;
};

/// Every base surface and every edit once, or a small file of each format.
std::vector<Seed> seeds_of(Target target);

}  // namespace koebe::fuzz
