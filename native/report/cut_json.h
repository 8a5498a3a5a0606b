// The report of a surface that was cut, as JSON.
#pragma once

#include "core/api.h"
#include "opened/cut_uniformize.h"

#include <nlohmann/json.hpp>

namespace koebe {

/// Figures over all pieces under the keys that to_json(UniformizeResult) has them under; "cuts", an array of {"kind",
/// "elements", "text"} whose elements are vertices along the path; "left_out", of {"face", "like"}; "pieces", each with
/// its faces, its place and its own figures, its circles in coordinates of its own unit disk. All numbers are the
/// input's.
KOEBE_API nlohmann::ordered_json to_json(const CutUniformizeResult& result);

}  // namespace koebe
