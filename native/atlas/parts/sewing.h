// Joins the two sides of cuts of a UV layer: two islands, or one island with itself.
#pragma once

#include "core/api.h"
#include "core/types.h"
#include "execution/execution.h"

#include <array>
#include <optional>
#include <vector>

namespace koebe {

struct SewingOptions {
    PlanarPoints uv = {};                          ///< (3F, 2) u and v of corner 3 f + k of face f
    std::vector<std::array<Index, 2>> edges = {};  ///< to sew, as pairs of vertices; those that are no cut stay
    std::vector<Index> polygon = {};               ///< (F) faces with one number are not cut apart; empty: all may be
    std::optional<double> even = {};               ///< E of the new islands, as in PartsOptions
};

struct SewnLayer {
    PlanarPoints uv;            ///< (3F, 2); corners of other islands keep their UVs
    std::vector<Index> island;  ///< (F) number of the new island of each face; -1: of an island that stays
    Index joined = 0;           ///< islands that became parts of new ones
    Index sewn = 0;             ///< edges
};

/// Makes one island of all islands that the edges join. A new island is mapped anew, one to one (parts.h), and lies
/// where its largest old island lay: at the same middle, size and turn, as well as a similarity can. It may lie over
/// islands that stay. Corners of a vertex with the same UVs, as 32-bit floats, at an edge are one point of the layer.
///
/// @param vertices (V, 3) @param triangles (F, 3)
/// @throws InputError UVs or edges; no edge is a cut with a face on either side; the largest island has no area;
/// SolverError the joined island cannot lie flat in one piece: it would close, or have a handle (elements: its edges
/// that were to be sewn); TopologyError, Cancelled
KOEBE_API SewnLayer sew_islands(const Vertices& vertices, const Triangles& triangles, const SewingOptions& options,
                                ExecutionContext& context);

}  // namespace koebe
