// Connected components of a surface.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

/// The pieces of faces of equal labels that edges connect. @param twin pair_halfedges's @param label (F)
/// @return the piece of each face, from 0 in the order of their first faces
std::vector<Index> connected_pieces(const std::vector<Index>& twin, const std::vector<int>& label, Index& count);

}  // namespace koebe
