// The space around a planar map and in its holes, triangulated: it keeps the map's loops apart.
#pragma once

#include "foldover/foldover_problem.h"

#include <vector>

namespace koebe {

/// Without points of its own but the frame's, the void has fewer unknowns, but less room to turn faces in.
enum class VoidPoints { frame, own };

struct VoidMesh {
    PlanarPoints points;  ///< (V + n, 2) points of the surface, four corners of the frame, other points of the void
    Triangles triangles;  ///< triangles of the void only, counter-clockwise
};

/// Triangulates the space between a frame and the outer loop, and the inside of each inner loop.
/// @param loops simple and apart; the loop that encloses most is the outer loop @param points (V, 2)
/// @throws InputError loops that are not simple, or not apart
VoidMesh void_mesh(const std::vector<VertexLoop>& loops, const PlanarPoints& points, VoidPoints wanted);

/// Adds the triangles of the void to a problem. They want to keep their present shapes (Jiang, Schaefer and Panozzo
/// 2017), or to become wider if they are narrower than the gap. As long as none turns over, no loops cross.
/// @param around made from the problem's points
/// @param weight of each of these triangles; small, so that they only hold the loops apart
/// @param gap wanted width between loops, in the unit of the points: wider triangles stay as wide, narrower ones lose
/// at most half their width; 0: they stay upright
/// @param problem its floors are set; empty weights become 1. New points follow its own ones: all are free but the
/// frame
void add_void(const VoidMesh& around, double weight, double gap, FoldoverProblem& problem);

}  // namespace koebe
