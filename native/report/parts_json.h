// The report of parts as JSON.
#pragma once

#include "core/api.h"
#include "parts/parts.h"

#include <nlohmann/json.hpp>

namespace koebe {

/// Everything but the UVs, as to_json of a uniformization. Lengths of cuts are over the root of the area.
KOEBE_API nlohmann::ordered_json to_json(const PartsResult& result);

}  // namespace koebe
