// Unfolds a surface of flat and rolled faces true to size: boxes, prisms, cylinders, cones, sheet metal.
#pragma once

#include "flat/flat_part.h"
#include "part_maps/part_mesh.h"

#include <optional>
#include <vector>

namespace koebe {

struct UnfoldOptions {
    double hard_angle = 30.0;  ///< in degrees: a crease is bent by more
    bool cut_hard = false;     ///< no island goes over a crease
    bool roomy = false;        ///< no island is so long that it keeps all islands of the square small
    bool compact = false;      ///< with `roomy`: not even as the cross of a cube does
};

struct UnfoldedParts {
    std::vector<FlatPart> parts;
    /// With `roomy`, and without `cut_hard`: the parts cut between planar regions, where the pieces need less room.
    /// Empty: nowhere.
    std::vector<FlatPart> roomier;
    std::vector<Index> rest;  ///< faces in no part, ascending
    double cut_length = 0.0;  ///< in the unit of the vertices
    double noise = 0.0;       ///< of the planar regions, in that unit (PlanarRegions)
};

/// Cuts a surface along its creases into charts, and lays the charts flat. A chart that closes round a hole, such as
/// the side of a cylinder, or that has a tip, such as a cone, is slit. Then charts with a straight border in common are
/// joined again, the longest border first, if they do not overlap. So a cube becomes a cross of six squares.
/// @return parts that keep all lengths, up to rounding, none roomier. No value if a chart is curved in both directions,
/// or overlaps itself
std::optional<UnfoldedParts> unfolded(const CutSurface& surface, ExecutionContext& context,
                                      const UnfoldOptions& options = {});

/// The flat and rolled regions of a hard surface, as parts that keep all lengths, and the rest: faces that are curved
/// in both directions. Regions are cut apart and joined as above. A planar region stays whole, with its holes.
/// @param surface of any genus, with or without boundary
/// @return no value if the surface is not hard: large flat and rolled regions hold less than a quarter of the area. If
/// one plate holds a tenth, only the plates are parts
std::optional<UnfoldedParts> hard_parts(const CutSurface& surface, ExecutionContext& context,
                                        const UnfoldOptions& options = {});

}  // namespace koebe
