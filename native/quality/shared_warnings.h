// Warnings that all maps give in one way.
#pragma once

#include "core/warning.h"

#include <string>
#include <vector>

namespace koebe {

/// That faces were turned to the orientation of the others, if there are any. @param faces rising
void warn_reoriented(const std::vector<Index>& faces, std::vector<Warning>& warnings, const std::string& advice = "");

/// That the map, or the parts with these faces, could not be made more even. @param faces rising
void warn_not_even(const std::vector<Index>& faces, std::vector<Warning>& warnings);

/// That the map is not one to one: how many faces are flipped above resolution, and what else is wrong.
/// @param flipped, below_resolution faces, rising @param others a few words each; empty ones do not count
void warn_not_one_to_one(const std::vector<Index>& flipped, const std::vector<Index>& below_resolution,
                         const std::vector<std::string>& others, std::vector<Warning>& warnings);

/// That loop vertices are not on their circles, if there are any. @param vertices in any order, each once or more
void warn_off_circle(std::vector<Index> vertices, std::vector<Warning>& warnings);

}  // namespace koebe
