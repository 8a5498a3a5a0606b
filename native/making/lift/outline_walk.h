// Walks outlines over a sheet: the points where they meet its edges and corners, and the chords between.
#pragma once

#include "lift/flat_sheet.h"
#include "lift/outline.h"

#include <vector>

namespace koebe {

/// A point of an outline: a vertex of the sheet, a point of an edge, or a point inside a face.
struct OutlineNode {
    Index vertex = -1;
    Index halfedge = -1;  ///< the lower one of its edge
    double share = 0.0;   ///< along that half-edge, between 0 and 1
    Index face = -1;      ///< where vertex and halfedge are -1
    Complex uv;           ///< in the chart of `face`, or of the half-edge's face
};

/// A node, and the face that the chord from the node before it runs through.
struct OutlineStep {
    Index node = -1;
    Index face = -1;
};

enum class WalkEnd {
    closed,   ///< the path came back to its start: the steps are the whole outline
    border,   ///< it meets a hole, a rim, a cut that is no period, or a face without area in the UVs
    too_fine  ///< it is too small for the numbers' precision, or it meets itself
};

struct OutlinePath {
    WalkEnd end = WalkEnd::closed;
    std::vector<OutlineStep> steps;
};

/// Follows an outline from its first point. Where the outline comes very near to a vertex or an edge, it is moved onto
/// the vertex or the edge. So no face becomes a sliver, and no vertex of the surface moves. Very near is a twentieth of
/// the outline's mean segment, or a tenth of the sheet's edge if that is less.
/// @param nodes new ones are appended
OutlinePath walk_outline(const FlatSheet& sheet, const DrawnOutline& outline, std::vector<OutlineNode>& nodes);

/// The node's place in the chart of a face that holds it.
Complex node_place(const FlatSheet& sheet, const OutlineNode& node, Index face);

}  // namespace koebe
