// Packs the islands of a UV layer as they are.
#pragma once

#include "core/api.h"
#include "core/map_options.h"
#include "core/types.h"
#include "execution/execution.h"
#include "quality/report.h"

#include <optional>
#include <vector>

namespace koebe {

struct PackedLayerOptions : MapOptions {
    PlanarPoints uv = {};             ///< (3F, 2) u and v of corner 3 f + k of face f, anywhere in the plane
    std::vector<Index> polygon = {};  ///< (F) faces with the same number are in one island; empty: each by itself
    double margin = 8.0;              ///< between two islands, and twice the distance from the border, in pixels
    int pixels = 2048;                ///< side of the texture, for `margin`
    int tiles = 1;                    ///< UDIM tiles, as in PartsOptions, but at least 1
    bool average_scale = false;       ///< all islands get one texel density; false: they keep their relative sizes
    /// (F) or empty. Islands with a face above 0 keep their place. The others go into the free space of the tiles, at
    /// the size that they have, or at one that is smaller where there is less room. With average_scale they get the
    /// texel density of those that keep their place, at most.
    std::vector<double> locked = {};
    std::optional<double> seconds = {};  ///< to look for a better packing; all of them are taken, on one tile
    CancelToken enough = {};             ///< ends the search: the best packing so far is taken
};

struct LayerIsland {
    std::vector<Index> faces;  ///< ascending
    bool overlaps = false;     ///< it lies on itself, or its border touches itself
    bool locked = false;       ///< it kept its place
};

/// `turned` are the faces of islands that lie with their back to the front. `flipped` are faces that are turned over
/// within their island, or have no area: packing mends none. `overlaps` counts islands that overlap themselves.
struct PackedLayer : CornerMapReport {
    std::vector<Index> part;           ///< (F) island of each face
    std::vector<LayerIsland> islands;  ///< in the order of their first faces
    int tiles = 1;                     ///< tiles that have islands
    /// Least distance of two islands, in pixels, unless both kept their place: many get less than the option.
    double margin = 0.0;
    double scale = 1.0;     ///< of the islands that were moved, against the layer: the root of their area's ratio
    double coverage = 0.0;  ///< area of the faces over that of the square or the tiles; faces on others count, too
};

/// Packs the islands of a UV layer into the unit square, or onto tiles, as large as it can (packing.h). Faces that
/// share a vertex with the same UVs, as 32-bit floats, are one island. Each island is moved by a similarity: none is
/// mirrored, and islands that overlap each other or themselves are moved as they are. Islands of which much of the
/// outline lies along the axes are turned by quarter turns only. Islands that keep their place may lie anywhere.
/// @param vertices (V, 3) @param triangles (F, 3), any faces
/// @throws InputError UVs are NaN or infinite (elements: faces), or not as many as corners; locked islands
/// leave no room for the others; SolverError, Cancelled
KOEBE_API PackedLayer pack_layer(const Vertices& vertices, const Triangles& triangles,
                                 const PackedLayerOptions& options, ExecutionContext& context);

}  // namespace koebe
