// Surfaces that a rotation or a reflection takes to each other.
#pragma once

#include "flat/flat_part.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace koebe {

struct Twin {
    std::size_t of = 0;         ///< the other part
    bool mirrored = false;      ///< it is a mirror image
    std::vector<Index> vertex;  ///< (V) of each vertex of the twin the vertex of the other part
};

/// Of each part the earlier part that it is congruent to, if there is one; that part is congruent to no earlier one. A
/// rotation, or a reflection for mirror images, takes the vertices to each other, to a thousandth of the part and 2e-4
/// of the root of the whole's area. Half-edges between polygons correspond one to one. Diagonals of polygons need not.
/// @param parts their half-edges, vertices and polygons count, their places do not @param may_mirror false: no
/// reflection
/// @param accepts (part, other, twin): further conditions; the next match is tried if it is false
std::vector<std::optional<Twin>>
congruent_parts(const std::vector<const FlatPart*>& parts, bool may_mirror,
                const std::function<bool(std::size_t)>& is_usable,
                const std::function<bool(std::size_t, std::size_t, const Twin&)>& accepts);

}  // namespace koebe
