// Warnings that all maps share.
#pragma once

#include "core/api.h"
#include "core/warning.h"
#include "mesh/topology.h"

#include <string>
#include <vector>

namespace koebe {

/// Warns that faces were turned to the orientation of the others, if any. @param faces ascending
KOEBE_API void warn_reoriented(const std::vector<Index>& faces, std::vector<Warning>& warnings,
                               const std::string& advice = "");

/// Warns that a closed surface encloses a negative volume: its map is the one of its mirror image.
/// @param vertices (V, 3) @param surface of these vertices
void warn_inside_out(const Vertices& vertices, const Surface& surface, std::vector<Warning>& warnings);

/// Warns that the map, or the parts with these faces, could not be made more even. @param faces ascending
void warn_not_even(const std::vector<Index>& faces, std::vector<Warning>& warnings);

/// Warns that the map is not one to one: how many faces are flipped above resolution, and other faults.
/// @param flipped, below_resolution faces, ascending @param others a few words each; empty strings do not count
void warn_not_one_to_one(const std::vector<Index>& flipped, const std::vector<Index>& below_resolution,
                         const std::vector<std::string>& others, std::vector<Warning>& warnings);

/// Warns of loop vertices off their circles, if any. @param vertices in any order, duplicates allowed
void warn_off_circle(std::vector<Index> vertices, std::vector<Warning>& warnings);

}  // namespace koebe
