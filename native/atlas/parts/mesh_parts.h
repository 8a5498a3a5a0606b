// The parts of a mesh: decided piece by piece, then made even together.
#pragma once

#include "execution/execution.h"
#include "flat/flat_part.h"
#include "parts/flat_piece.h"
#include "parts/parts.h"

#include <optional>
#include <vector>

namespace koebe {

/// A piece of the mesh and its parts, flat.
struct FlatPiece {
    PieceInput input;
    std::vector<FlatPart> parts = {};  ///< by numbers of the piece
};

struct MeshParts {
    std::vector<FlatPart> parts;  ///< by numbers of the input
    double even = 0.0;            ///< E
    std::vector<Index> not_even;  ///< faces of the input whose parts stayed conformal, ascending
    double maps = 0.0;            ///< faces mapped, over the mesh's
};

/// Decides the parts of pieces, on proxies if there are many faces, then makes all parts even.
/// @param pieces with parts that are decided already, or without @param only_uncut nothing else is asked for than one
/// part without a cut @return nothing if that is known to fail before all is done
std::optional<MeshParts> mesh_parts(std::vector<FlatPiece> pieces, const PartsOptions& options, bool only_uncut,
                                    ExecutionContext& context);

}  // namespace koebe
