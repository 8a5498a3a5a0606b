// The warnings of a surface that was cut.
#pragma once

#include "core/api.h"
#include "opened/cut_uniformize.h"

#include <string>
#include <vector>

namespace koebe {

/// What was done in the UVs: "a loop through a handle, 13 vertices".
KOEBE_API std::string cut_text(const SurfaceCut& cut);

/// What cutting did, and the warnings of all pieces, those of one kind as one.
std::vector<Warning> cut_warnings(const CutUniformizeResult& result);

}  // namespace koebe
