// Pieces of a mesh that are copies or mirror images of each other are cut alike.
#pragma once

#include "parts/layout.h"

namespace koebe {

/// Cuts pieces of the mesh alike that are copies or mirror images of each other: each gets the parts of the piece with
/// the shortest outlines. Faces and polygons correspond one to one. A piece is a set of parts that share vertices.
void cut_alike(FlatMesh& mesh);

}  // namespace koebe
