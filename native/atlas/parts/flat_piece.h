// A piece of a mesh, cut into parts that lie flat.
#pragma once

#include "cut/open_surface.h"
#include "execution/execution.h"
#include "parts/even_parts.h"
#include "parts/flat_part.h"
#include "parts/flat_parts.h"
#include "parts/parts.h"

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

/// The piece, closed if only a slit opened it.
CutSurface whole_of(const PieceInput& input);

/// Whether rims of parts may have any form: E is not 0, and none of round loops, round cuts, slits is asked for.
bool rims_are_free(const PartsOptions& options);

EvenOptions evening_of(const PartsOptions& options, bool roomy, int threads);

/// The parts of a piece, flat. They name faces and vertices by the numbers of the piece.
FlatParts flat_piece(const PieceInput& input, PieceSurface surface, const PartsOptions& options, int threads,
                     ExecutionContext& context, SplitEffort& effort);

}  // namespace koebe
