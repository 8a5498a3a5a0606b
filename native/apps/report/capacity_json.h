// The JSON report of enclosed capacities.
#pragma once

#include "certified/capacities.h"
#include "core/api.h"

#include <nlohmann/json.hpp>

namespace koebe {

/// {"version", "input", "converged", "width", "faces", "levels", "capacities", "warnings"}, "modulus" for two loops,
/// and if the module is enclosed its numbers under their names ("r_1", "y_2", ...) and its "loops" in their order. Each
/// number is {"lower", "upper"}, a capacity with its loops "low" and "high" before; "input" is empty, as in
/// to_json(UniformizeResult).
KOEBE_API nlohmann::ordered_json to_json(const CapacityReport& report);

}  // namespace koebe
