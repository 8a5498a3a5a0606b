// The JSON report of a surface that was cut.
#pragma once

#include "core/api.h"
#include "opened/cut_uniformize.h"

#include <nlohmann/json.hpp>

namespace koebe {

/// Figures over all pieces have the keys of to_json(UniformizeResult). "cuts" is an array of {"kind", "elements",
/// "text"} whose elements are vertices along the path; "left_out" of {"face", "like"}. Each of "pieces" has its faces,
/// its place and its own figures, its circles in coordinates of its own unit disk. Numbers of vertices and faces
/// are numbers in the input.
KOEBE_API nlohmann::ordered_json to_json(const CutUniformizeResult& result);

}  // namespace koebe
