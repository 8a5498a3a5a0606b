// The order in which faces and vertices are numbered: where it begins, and how it goes on.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

/// Faces and the half-edges across their edges; those of one patch are joined by these.
struct JoinedFaces {
    const Triangles& triangles;
    const std::vector<Index>& twin;  ///< (3F) or no_twin
    Index vertex_count = 0;
    std::vector<Index> patch = {};  ///< (F) from 0, -1: of none; empty: all faces are one patch
    Index patches = 1;
};

/// The half-edge of each patch that a walk over its faces is to begin with; patches of more faces come first.
///
/// It is the longest boundary edge, or the longest edge of a patch without boundary. Among edges as long it is one
/// whose neighbourhood is like few others, and of these the first by a hash of edge lengths (Weisfeiler and Lehman
/// 1968); of several patches the distances from the middle of all are in the hash too.
/// @param positions (V, 3) about 0 and of about unit size
std::vector<Index> first_halfedges(const JoinedFaces& faces, const Vertices& positions);

/// A walk over the faces, breadth first, each entered by a half-edge of its own.
struct FaceWalk {
    std::vector<Index> entered;   ///< half-edges
    std::vector<Index> vertices;  ///< as they are met
};

FaceWalk walk_from(const JoinedFaces& faces, const std::vector<Index>& starts);

}  // namespace koebe
