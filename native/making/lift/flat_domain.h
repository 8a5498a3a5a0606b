// The flat domain of a surface, as a sheet.
#pragma once

#include "lift/flat_sheet.h"
#include "lift/lift.h"
#include "lift/sphere_sheets.h"
#include "mesh/topology.h"

#include <optional>

namespace koebe {

struct FlatDomain {
    Surface surface;                  ///< of the input, its faces in one orientation, as the sheet has them
    FlatSheet flat;                   ///< empty if there is a sphere
    std::optional<FlatSheet> filled;  ///< if outlines are clipped (filled_sheet.h)
    std::optional<SphereSheets> sphere;
    std::optional<Circle> hole;  ///< of the unit disk, if the pattern lies around one
    MapReport map;

    const FlatSheet& sheet() const { return sphere ? sphere->home : flat; }
    /// The sheet that outlines are followed in.
    const FlatSheet& walked() const { return filled ? *filled : sheet(); }
    /// The sheet for a pattern around a point, and its number among the sphere's charts or -1.
    int middle_chart() const { return !sphere ? -1 : sphere->charts.size() == 3 ? 2 : 0; }
    const FlatSheet& placing_sheet() const { return sphere ? sphere->charts[middle_chart()] : flat; }
};

/// Maps the surface by `uniformize`, `ring_map`, `torus_map`, `sphere_map` or `parts_of`.
/// @throws as these maps; SolverError the map is not one to one; InputError faces too large on it, a
/// vertex that does not exist, or on no hole
FlatDomain flat_domain(const Vertices& vertices, const Triangles& triangles, const LiftOptions& options,
                       ExecutionContext& context);

}  // namespace koebe
