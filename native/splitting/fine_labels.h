// The parts of a coarse surface on the fine one.
#pragma once

#include "execution/execution.h"
#include "splitting/coarse_surface.h"

#include <vector>

namespace koebe {

/// Faces far from the coarse cuts get the label of the coarse part there; between two labels runs a minimum cut of the
/// fine surface (dual_cut.h). Pieces beside a label's largest one go to their neighbours.
/// @param label of each coarse face, from 0 to count, each label connected
/// @return (F) of the fine surface's faces, each label connected; one may be missing
std::vector<int> fine_labels(const CutSurface& whole, const CoarseSurface& coarse, const std::vector<int>& label,
                             int count, ExecutionContext& context);

}  // namespace koebe
