// The order in which faces and vertices are numbered: its start and its steps.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

/// Faces, and for each half-edge its twin in the neighbouring face. Twins join the faces of a patch.
struct JoinedFaces {
    const Triangles& triangles;
    const std::vector<Index>& twin;  ///< (3F) or no_twin
    Index vertex_count = 0;
    std::vector<Index> patch = {};  ///< (F) from 0; -1: no patch; empty: all faces are one patch
    Index patches = 1;
};

/// The half-edge of each patch at which a walk over its faces starts. Larger patches come first.
///
/// It is the longest boundary edge, or the longest edge of a patch without boundary. Among edges of equal length, edges
/// with a rare neighbourhood are preferred, and then the first edge by a hash of edge lengths (Weisfeiler and Lehman
/// 1968). With several patches the hash includes distances from the middle of all patches.
/// @param positions (V, 3) about 0 and of about unit size
std::vector<Index> first_halfedges(const JoinedFaces& faces, const Vertices& positions);

/// A walk over the faces, breadth first. Each face is entered by a half-edge of its own.
struct FaceWalk {
    std::vector<Index> entered;   ///< half-edges
    std::vector<Index> vertices;  ///< in the order of the walk
};

FaceWalk walk_from(const JoinedFaces& faces, const std::vector<Index>& starts);

}  // namespace koebe
