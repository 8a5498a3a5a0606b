// The charts between a surface's creases, laid flat.
#pragma once

#include "cut/seamed_mesh.h"
#include "part_maps/part_mesh.h"

#include <optional>
#include <set>
#include <vector>

namespace koebe {

struct FlatCharts {
    SeamedMesh net;                         ///< the surface, cut into charts. Edges count as longer where it is shown
    std::vector<Complex> at;                ///< (3F) places of the corners, true to size
    std::vector<std::vector<Index>> faces;  ///< of each chart, ascending
    std::vector<Index> slits, darts;        ///< half-edges of cuts inside charts, one each
    std::set<Index> tips;                   ///< vertices where darts end
    double near = 0.0;                      ///< places are the same up to this distance
};

/// Cuts the surface along its creases, which are bent by more than 30 degrees. A chart that closes round a hole, such
/// as the side of a cylinder, is slit, and a chart with a tip, such as a cone, gets a dart.
/// @return charts that may overlap themselves. No value if a chart is curved in both directions, or if there are too
/// many charts and tips: then the surface is smooth, or rough
std::optional<FlatCharts> flat_charts(const CutSurface& surface);

}  // namespace koebe
