// A piece of a mesh as a surface to cut.
#pragma once

#include "cut/open_surface.h"
#include "part_maps/part_mesh.h"

#include <vector>

namespace koebe {

/// A piece and what is known of its elements. Vertices of one source lie in one place: a slit parts them.
struct PieceInput {
    SurfacePiece piece;                          ///< in the unit in which the mesh has area 1
    std::vector<Index> polygon = {}, face = {};  ///< as in CutSurface, and so are
    std::vector<char> slit = {}, seam = {};
    std::vector<double> shown = {};
};

/// The piece as a surface to cut: closed if only a slit opened it, and if a curve cuts it in two. It is cut in two
/// first, too, if it is nearly closed.
struct PieceSurface {
    CutSurface whole;
    std::vector<std::vector<Index>> first = {};  ///< faces of the first parts; empty: one part with all faces
};
PieceSurface surface_of(const PieceInput& input);

/// The piece with the boundary that it came with.
CutSurface opened_surface(const PieceInput& input);

/// The piece, closed if only a slit opened it.
CutSurface whole_of(const PieceInput& input);

}  // namespace koebe
