// The JSON report of a lifted pattern.
#pragma once

#include "core/api.h"
#include "lift/lift.h"

#include <nlohmann/json.hpp>

namespace koebe {

/// {"version", "input", "shape", "pattern", "size", "bridge", "bend", "outlines", "left_out", "loops", "euler",
/// "vertices", "faces", "closed", "converged", the map's distortion, "seconds", "peak_memory_mb", "warnings"}
KOEBE_API nlohmann::ordered_json to_json(const LiftResult& result);

}  // namespace koebe
