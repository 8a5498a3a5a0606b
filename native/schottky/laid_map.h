// The map of a cut surface put together to UVs: along which circles or edges they are cut, and flips turned back.
#pragma once

#include "execution/execution.h"
#include "schottky/cut_map.h"
#include "schottky/finer_faces.h"
#include "schottky/schottky_tile.h"

#include <vector>

namespace koebe {

/// A map, put together to the UVs.
struct LaidMap {
    CutMap map;
    SchottkyTile tile;
    SchottkyFaults faults;
    bool by_circles = false;

    bool tangled() const { return faults.flipped.size() > faults.below_resolution.size(); }
    /// So many flips that repairs would take long and leave some.
    bool hopeless() const { return faults.flipped.size() > faults.below_resolution.size() + tile.triangles.rows() / 5; }
};

/// Flipped faces are turned back in tiles that are bounded elsewhere, too: their boundaries are held.
/// @param polygon as in SchottkyOptions
LaidMap laid_map(CutMap map, const FinerFaces& faces, const std::vector<Index>& polygon, ExecutionContext& context);

}  // namespace koebe
