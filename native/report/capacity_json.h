// The JSON report of enclosed capacities.
#pragma once

#include "certified/capacities.h"
#include "core/api.h"

#include <nlohmann/json.hpp>

namespace koebe {

/// {"version", "input", "converged", "width", "faces", "levels", "capacities"}, and "modulus" and "r_1" for two loops.
/// Each number is {"lower", "upper"}, a capacity with its loops "low" and "high" before; "input" is empty, as in
/// to_json(UniformizeResult).
KOEBE_API nlohmann::ordered_json to_json(const CapacityReport& report);

}  // namespace koebe
