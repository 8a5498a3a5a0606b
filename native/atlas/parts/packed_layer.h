// Packs the islands of a UV layer as they are.
#pragma once

#include "core/api.h"
#include "core/map_options.h"
#include "core/types.h"
#include "execution/execution.h"
#include "quality/report.h"

#include <vector>

namespace koebe {

struct PackedLayerOptions : MapOptions {
    PlanarPoints uv = {};             ///< (3F, 2) u and v of corner 3 f + k of face f, anywhere in the plane
    std::vector<Index> polygon = {};  ///< (F) faces with the same number are in one island; empty: each by itself
    double margin = 8.0;              ///< between two islands, and twice the distance from the border, in pixels
    int pixels = 2048;                ///< side of the texture, for `margin`
    int tiles = 1;                    ///< UDIM tiles, as in PartsOptions, but at least 1
    bool average_scale = false;       ///< all islands get one texel density; false: they keep their relative sizes
};

struct LayerIsland {
    std::vector<Index> faces;  ///< ascending
    bool overlaps = false;     ///< it lies on itself, or its border touches itself
};

/// `turned` are the faces of islands that lie with their back to the front. `flipped` are faces that are turned over
/// within their island, or have no area: packing mends none. `overlaps` counts islands that overlap themselves.
struct PackedLayer : CornerMapReport {
    std::vector<Index> part;           ///< (F) island of each face
    std::vector<LayerIsland> islands;  ///< in the order of their first faces
    int tiles = 1;                     ///< tiles that have islands
    double margin = 0.0;               ///< least distance of two islands, in pixels: many get less than the option
    double coverage = 0.0;  ///< area of the faces over that of the square or the tiles; faces on others count, too
};

/// Packs the islands of a UV layer into the unit square, or onto tiles, as large as it can (packing.h). Faces that
/// share a vertex with the same UVs, as 32-bit floats, are one island. Each island is moved by a similarity: none is
/// mirrored, and islands that overlap each other or themselves are moved as they are. Islands of which much of the
/// outline lies along the axes are turned by quarter turns only.
/// @param vertices (V, 3) @param triangles (F, 3), any faces
/// @throws InputError UVs are NaN or infinite (elements: faces), or not as many as corners; SolverError, Cancelled
KOEBE_API PackedLayer pack_layer(const Vertices& vertices, const Triangles& triangles,
                                 const PackedLayerOptions& options, ExecutionContext& context);

}  // namespace koebe
