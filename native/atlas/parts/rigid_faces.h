// Faces of parts that lie true to size, which mends of polygons leave as they are.
#pragma once

#include "execution/execution.h"
#include "parts/flat_mesh.h"

#include <vector>

namespace koebe {

/// The vertices of the input at faces that lie true to size, as flat and rolled regions do; none of a mesh of
/// triangles, whose vertices nothing moves.
std::vector<Index> rigid_vertices(const FlatMesh& mesh);

/// Makes polygons convex with free rims, as long as the part stays one to one. Rigid faces and divided edges stay.
/// Packing keeps the parts apart afterwards.
void mend_rims(FlatMesh& mesh, int threads, ExecutionContext& context);

}  // namespace koebe
