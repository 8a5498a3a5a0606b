// The JSON report of a map to a fundamental domain of a Schottky group.
#pragma once

#include "schottky/schottky_map.h"

#include <nlohmann/json.hpp>

namespace koebe {

KOEBE_API nlohmann::ordered_json to_json(const SchottkyResult& result);

}  // namespace koebe
