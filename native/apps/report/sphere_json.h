// The JSON report of a map to the sphere.
#pragma once

#include "core/api.h"
#include "sphere/sphere_map.h"

#include <nlohmann/json.hpp>

namespace koebe {

/// Everything but the points and the UVs; "input" is empty, as in to_json(UniformizeResult).
KOEBE_API nlohmann::ordered_json to_json(const SphereResult& result);

}  // namespace koebe
