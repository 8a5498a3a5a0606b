// The space around a planar map and in its holes, triangulated: it keeps the map's loops apart.
#pragma once

#include "foldover/foldover_problem.h"

#include <vector>

namespace koebe {

/// Adds the triangles of the void to a problem: between a frame and the outer loop, and inside each inner loop. They
/// want to keep their present shapes (Jiang, Schaefer and Panozzo 2017), or to become wider if they are narrower than
/// the gap. As long as none turns over, no loops cross.
/// @param loops of the problem's map, simple and apart; the loop that encloses most is the outer loop
/// @param weight of each of these triangles; small, so that they only hold the loops apart
/// @param gap wanted width between loops, in the unit of the points: wider triangles stay as wide, narrower ones lose
/// at most half their width; 0: they stay upright
/// @param problem its floors are set; empty weights become 1. New points follow its own ones: all are free but the
/// frame
/// @throws InputError loops that are not simple, or not apart
void add_void(const std::vector<VertexLoop>& loops, double weight, double gap, FoldoverProblem& problem);

}  // namespace koebe
