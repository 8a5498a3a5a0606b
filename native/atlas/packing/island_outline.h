// The outline of an island, whatever its faces do.
#pragma once

#include "core/types.h"
#include "packing/packing.h"

#include <array>
#include <utility>
#include <vector>

namespace koebe {

/// The outline of an island's faces, and whether the island overlaps itself.
/// @param points (V, 2) @param faces counter-clockwise ones; those without area may be any way round
std::pair<Outline, bool> outline_of_faces(const PlanarPoints& points, const std::vector<std::array<Index, 3>>& faces);

}  // namespace koebe
