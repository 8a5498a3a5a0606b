// Faces of charts as one part.
#pragma once

#include "hard/flat_charts.h"

#include <optional>
#include <vector>

namespace koebe {

/// Some faces of charts as they lie. @return no value if they are no disk with holes, or overlap
std::optional<FlatPart> laid_part(const CutSurface& surface, const FlatCharts& charts, const std::vector<Index>& faces);

}  // namespace koebe
