// The JSON report of a flat pattern.
#pragma once

#include "core/api.h"
#include "flatten/flatten.h"

#include <nlohmann/json.hpp>

namespace koebe {

/// Everything but the places and the drawing. Lengths are in millimetres, stretches in per cent.
KOEBE_API nlohmann::ordered_json to_json(const FlattenResult& result);

}  // namespace koebe
