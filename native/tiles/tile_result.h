// What is reported of a map to a torus or a cylinder.
#pragma once

#include "tiles/tile.h"
#include "tiles/tile_map.h"

namespace koebe {

/// Made more even, flips turned back, the tile cut and checked, and all figures of it but seconds.
/// @param map converged or not
TileResult tile_result(const Vertices& vertices, const Triangles& triangles, const PeriodicSurface& domain,
                       const TileOptions& options, HoleShape holes, FlatMap& map, ExecutionContext& context);

/// A map to a torus or a cylinder.
using TileMap = TileResult(const Vertices& vertices, const Triangles& triangles, const TileOptions& options,
                           ExecutionContext& context);

/// The map made on the canonical mesh, off this thread, so that it follows from the shape alone.
TileResult canonical_tile(const Vertices& vertices, const Triangles& triangles, const TileOptions& options,
                          ExecutionContext& context, TileMap* map);

}  // namespace koebe
