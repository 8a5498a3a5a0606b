// A piece of a mesh while its parts are decided: on itself, unfolded, or on a proxy.
#pragma once

#include "execution/execution.h"
#include "parts/flat_piece.h"
#include "parts/mesh_parts.h"
#include "proxies/proxy.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace koebe {

/// A piece and how far its parts are decided.
struct MeshPiece : FlatPiece {
    std::optional<Proxy> proxy = {};            ///< on which the parts were decided
    std::optional<PieceInput> filled = {};      ///< the piece without its pinholes: the proxy's fine surface is of it,
    std::optional<PieceSurface> open = {};      ///< and this is the surface with its pinholes
    bool is_fine = true;                        ///< whether the parts name elements of the piece, not of the proxy
    std::vector<FlatPart> conformal = {};       ///< fine parts at E = 0, without darts, to compare with
    bool is_measured = false;                   ///< whether these only compare: they are no result
    bool is_joined = false;                     ///< and that some of them are parts of one part: they cannot replace it
    std::vector<std::size_t> group = {};        ///< (parts) parts of one group were one part before they were cut, or
                                                ///< are joined from the conformal parts of this group
    std::vector<std::size_t> uncut_group = {};  ///< (conformal)

    /// The piece whose numbers parts may name.
    const SurfacePiece& named() const { return filled ? filled->piece : input.piece; }
    /// The piece as a surface that has its pinholes.
    const PieceSurface& surface() const { return open ? *open : proxy->fine; }
};

/// Decides the parts of a piece: unfolded if few cuts do it, else split on a proxy if it is large, else on itself.
/// Of an unfolded layout with long cuts and the parts of splitting the one stays that costs less once it is even.
/// @param total faces of all pieces whose parts are decided
void decide_parts(MeshPiece& own, Eigen::Index total, const PartsOptions& options, int threads,
                  ExecutionContext& context, SplitEffort& effort);

}  // namespace koebe
