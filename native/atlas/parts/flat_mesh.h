// A mesh cut into its parts, each flat by itself.
#pragma once

#include "core/types.h"
#include "execution/execution.h"
#include "parts/layout.h"
#include "parts/parts.h"

#include <vector>

namespace koebe {

/// @throws as parts_of
FlatMesh flat_mesh(const Vertices& vertices, const Triangles& triangles, const PartsOptions& options,
                   ExecutionContext& context);

/// (V) for each vertex the first vertex with the same coordinates.
std::vector<Index> first_in_place(const Vertices& vertices);

/// The length of a layout's unit in the unit of the mesh.
double root_of_area(const Vertices& vertices, const Triangles& triangles);

}  // namespace koebe
