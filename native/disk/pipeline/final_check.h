// Checks the promises of every map at its end: finite, one to one, inside the disk, true to its circles.
#pragma once

#include "circles/circle.h"
#include "core/warning.h"

#include <string>
#include <utility>
#include <vector>

namespace koebe {

/// The faults of a map; all empty if it keeps its promises.
struct MapFaults {
    std::vector<Index> not_finite;  ///< vertices
    std::vector<Index> outside;     ///< vertices outside the closed unit disk
    std::vector<Index> flipped;     ///< faces as stored, except those below resolution
    std::vector<int>
        bad_circles;  ///< loops whose circle is not positive and finite, leaves the disk, meets another, or is turned
    std::vector<std::pair<Index, Index>> crossings;  ///< loop edges that meet, each by its first vertex

    bool any() const
    {
        return !not_finite.empty() || !outside.empty() || !flipped.empty() || !bad_circles.empty() ||
               !crossings.empty();
    }
    /// A warning that starts with `beginning` and names the first elements, in the input's numbering.
    Warning warning(const std::string& beginning, const std::vector<Index>& original,
                    const std::vector<Index>& original_faces) const;
};

/// @param uv (V, 2) @param circles of the loops, the outer one first
MapFaults find_faults(const Triangles& triangles, const std::vector<VertexLoop>& loops, const PlanarPoints& uv,
                      const std::vector<Circle>& circles);

}  // namespace koebe
