// What parts report of their layout.
#pragma once

#include "parts/layout.h"
#include "parts/pack_parts.h"
#include "parts/parts.h"

#include <utility>
#include <vector>

namespace koebe {

inline constexpr const char* lower_price = "A lower price makes more parts, and more even ones";  ///< an advice

/// The value below which a share of the weight lies. @param values (value, weight), rising; not empty
double quantile(const std::vector<std::pair<double, double>>& values, double share);

/// What the layout says, as the UVs are stored.
/// @param pixels_per_unit pixels along the square, over the length of the layout's unit in the mesh's
void describe(PartsLayout& layout, const Vertices& vertices, const Triangles& triangles, const PackedParts& packed,
              const PartsOptions& options, double pixels_per_unit, PartsResult& result);

}  // namespace koebe
