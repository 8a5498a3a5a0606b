// Puts the map of a cut surface together to UVs: cuts along circles or edges, and turns flips back.
#pragma once

#include "execution/execution.h"
#include "schottky/cut_map.h"
#include "schottky/finer_faces.h"
#include "schottky/schottky_tile.h"

#include <vector>

namespace koebe {

/// A map and its UVs.
struct LaidMap {
    CutMap map;
    SchottkyTile tile;
    SchottkyFaults faults;
    bool by_circles = false;

    bool tangled() const { return faults.flipped.size() > faults.below_resolution.size(); }
    /// Whether there are so many flips that repairs would take long and leave some.
    bool hopeless() const { return faults.flipped.size() > faults.below_resolution.size() + tile.triangles.rows() / 5; }
};

/// Puts a map together. Flipped faces are turned back in tiles with other boundaries, too, as boundaries are held.
/// @param polygon as in SchottkyOptions
LaidMap laid_map(CutMap map, const FinerFaces& faces, const std::vector<Index>& polygon, ExecutionContext& context);

}  // namespace koebe
