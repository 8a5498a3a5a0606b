// Carries the parts of a coarse surface over to the fine surface.
#pragma once

#include "execution/execution.h"
#include "splitting/coarse_surface.h"

#include <vector>

namespace koebe {

/// Faces far from the coarse cuts get the label of the coarse part. Between two labels runs a minimum cut of the fine
/// surface (dual_cut.h). If a label has several pieces, the largest keeps it. The others take their neighbours' labels.
/// @param label the label of each coarse face, from 0 to count; each label is connected
/// @return (F) the label of each fine face; each label is connected, and a label may be missing
std::vector<int> fine_labels(const CutSurface& whole, const CoarseSurface& coarse, const std::vector<int>& label,
                             int count, ExecutionContext& context);

}  // namespace koebe
