// The JSON report of parts.
#pragma once

#include "core/api.h"
#include "parts/parts.h"

#include <nlohmann/json.hpp>

namespace koebe {

/// Everything but the UVs, as for a uniformization. Lengths of cuts are over the square root of the area.
KOEBE_API nlohmann::ordered_json to_json(const PartsResult& result);

}  // namespace koebe
