// The JSON report of a map to a torus or a cylinder.
#pragma once

#include "core/api.h"
#include "tiles/tile_map.h"

#include <nlohmann/json.hpp>

namespace koebe {

/// Everything but the UVs; "input" is empty, as in to_json(UniformizeResult).
KOEBE_API nlohmann::ordered_json to_json(const TileResult& result);

}  // namespace koebe
