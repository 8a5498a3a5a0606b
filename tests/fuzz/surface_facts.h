// What a mesh is, found without the library: the other opinion on its topology.
#pragma once

#include "program.h"

#include <map>
#include <optional>
#include <utility>

namespace koebe::fuzz {

using Edge = std::pair<Index, Index>;  ///< the smaller vertex first

/// A connected, orientable surface of genus 0 with boundary.
struct SurfaceFacts {
    std::vector<std::array<Index, 3>> faces;  ///< turned to one orientation, either of the two
    std::size_t reversed = 0;                 ///< how many of them were
    std::vector<Edge> boundary;               ///< sorted
    std::size_t loop_count = 0;
};

/// Whether the arrays are a mesh at all: indices in range, three of them different, coordinates finite.
bool arrays_are_a_mesh(const Soup& soup);

/// Nothing if the mesh is not such a surface, or no mesh.
std::optional<SurfaceFacts> surface_facts(const Soup& soup);

}  // namespace koebe::fuzz
