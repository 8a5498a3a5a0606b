// Flat parts with fewer faces, on which their cuts are decided.
#pragma once

#include "execution/execution.h"
#include "parts/flat_part.h"

#include <vector>

namespace koebe {

struct CoarseParts {
    std::vector<FlatPart> parts;             ///< as the fine parts are ordered
    std::vector<std::vector<Index>> vertex;  ///< (parts, V) the fine part's vertex that each vertex is
};

/// All parts with about `faces` faces together: edges of about one length on the whole surface (coarse_surface.h).
/// Mirror images stay mirror images as far as edges can go in pairs. The vertices keep their places in the map, and
/// faces the numbers of faces of the whole. They may be cut along any edge. A part that cannot be coarsened, or has
/// darts already, stays as it is.
CoarseParts coarse_parts(const std::vector<FlatPart>& fine, Index faces, ExecutionContext& context);

}  // namespace koebe
