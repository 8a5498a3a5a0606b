// A piece with fewer faces, on which its parts and their cuts are decided.
#pragma once

#include "execution/execution.h"
#include "splitting/coarse_surface.h"
#include "splitting/piece_surface.h"

namespace koebe {

struct Proxy {
    PieceSurface fine;
    CoarseSurface coarse;      ///< its vertices and faces come from the fine surface
    Surface surface;           ///< of the coarse triangles
    bool is_mirrored = false;  ///< whether the coarse surface was made of one side and its mirror image
    PieceInput input;          ///< the coarse piece: its sources are the coarse surface's numbers
};

/// @param faces about so many @param fine of the input
Proxy proxy_of(const PieceInput& input, PieceSurface fine, Index faces, ExecutionContext& context);

}  // namespace koebe
