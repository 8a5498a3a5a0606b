// The JSON report of a packed UV layer.
#pragma once

#include "core/api.h"
#include "packing/packed_layer.h"

#include <nlohmann/json.hpp>

namespace koebe {

/// Everything but the UVs.
KOEBE_API nlohmann::ordered_json to_json(const PackedLayer& result);

}  // namespace koebe
