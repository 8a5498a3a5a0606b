// The flat domain of a surface, as a sheet.
#pragma once

#include "lift/flat_sheet.h"
#include "lift/lift.h"
#include "mesh/topology.h"

namespace koebe {

struct FlatDomain {
    Surface surface;  ///< of the input, its faces in one orientation, as the sheet has them
    FlatSheet sheet;
    MapReport map;
};

/// Maps the surface by `uniformize`, `ring_map`, `torus_map` or `parts_of`.
/// @throws as these maps
FlatDomain flat_domain(const Vertices& vertices, const Triangles& triangles, const LiftOptions& options,
                       ExecutionContext& context);

}  // namespace koebe
