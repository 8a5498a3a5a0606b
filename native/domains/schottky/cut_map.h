// Maps a surface whose handles are cut open, before its faces are put together to UVs.
#pragma once

#include "execution/execution.h"
#include "quality/report.h"
#include "schottky/finer_faces.h"
#include "schottky/handle_cut.h"
#include "schottky/schottky_group.h"
#include "schottky/schottky_map.h"

#include <vector>

namespace koebe {

/// A cut surface and its map.
struct CutMap {
    HandleCut cut;
    SchottkyPlane plane;
    FundamentalCircles circles;
    bool converged = false;
    std::vector<double> changes;
};

/// Maps the surface cut along edges, and then cut along circles as long as there are such circles.
/// @param seconds out: sum over their metrics, factors and iterations
std::vector<CutMap> cut_maps(HandleCut cut, const FinerFaces& faces, const SchottkyOptions& options,
                             StageSeconds& seconds, ExecutionContext& context);

}  // namespace koebe
