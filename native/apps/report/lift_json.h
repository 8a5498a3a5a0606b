// The JSON report of a lifted pattern.
#pragma once

#include "core/api.h"
#include "lift/lift.h"

#include <nlohmann/json.hpp>

namespace koebe {

/// The report of every map (report_json), with {"shape", "pattern", "size", "bridge", "bend", "outlines", "islands",
/// "crossings", "left_out", "loops", "euler", "closed", "converged"}; "vertices" and "faces" count the vertices and
/// faces of the result.
KOEBE_API nlohmann::ordered_json to_json(const LiftResult& result);

}  // namespace koebe
