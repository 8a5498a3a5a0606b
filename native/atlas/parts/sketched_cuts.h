// Where a mesh is cut, as far as it is decided: a sketch for whoever waits for the map.
#pragma once

#include "execution/execution.h"
#include "flat/flat_part.h"
#include "parts/mesh_piece.h"
#include "parts/parts.h"

#include <vector>

namespace koebe {

/// The edges on the boundary of each part, by the vertices that it names, the lower one first.
CutEdges boundaries_of(const std::vector<FlatPart>& parts);

/// The same of pieces, by vertices of the input. Cuts of a proxy follow edges of the fine surface, and are there twice.
/// Pieces that are not decided yet have none.
CutEdges sketched_boundaries(const std::vector<MeshPiece>& pieces, const ExecutionContext& context);

/// The edges on more than one boundary, or on one twice, each once: the cuts.
CutEdges repeated(CutEdges boundaries);

}  // namespace koebe
