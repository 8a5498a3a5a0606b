// The warnings of a surface that was cut.
#pragma once

#include "core/api.h"
#include "opened/cut_uniformize.h"

#include <string>
#include <vector>

namespace koebe {

/// Describes a cut in the UVs: "a loop through a handle, 13 vertices".
KOEBE_API std::string cut_text(const SurfaceCut& cut);

/// The warnings about cuts and the warnings of all pieces, merged by kind.
std::vector<Warning> cut_warnings(const CutUniformizeResult& result);

}  // namespace koebe
