// Reports a map to a torus or a cylinder.
#pragma once

#include "tiles/tile.h"
#include "tiles/tile_map.h"

namespace koebe {

/// Makes the map more even, turns flips back, cuts and checks the tile, and measures everything but seconds.
/// @param map converged or not
TileResult tile_result(const Vertices& vertices, const Triangles& triangles, const PeriodicSurface& domain,
                       const TileOptions& options, HoleShape holes, FlatMap& map, ExecutionContext& context);

/// A map to a torus or a cylinder.
using TileMap = TileResult(const Vertices& vertices, const Triangles& triangles, const TileOptions& options,
                           ExecutionContext& context);

/// Makes the map on the canonical mesh, off this thread, so that it follows from the shape alone.
TileResult canonical_tile(const Vertices& vertices, const Triangles& triangles, const TileOptions& options,
                          ExecutionContext& context, TileMap* map);

}  // namespace koebe
