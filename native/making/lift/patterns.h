// The built-in patterns, as outlines on a sheet.
#pragma once

#include "circles/circle.h"
#include "core/api.h"
#include "lift/flat_sheet.h"
#include "lift/outline.h"
#include "lift/sphere_sheets.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace koebe {

struct PatternOptions {
    double size = 0.0;    ///< of a cell with its share of the bridge, in the unit of the vertices
    double bridge = 0.0;  ///< between two outlines
    int repeats = 0;      ///< of a lattice round a ring or a hole; 0: it follows from the size
    std::uint64_t seed = 1;
    double turn = 0.0;                ///< of a lattice, degrees counter-clockwise
    std::optional<Circle> hole = {};  ///< of the unit disk: a lattice's rows lie around it
    int rows = 0;                     ///< around the hole, beginning there; 0: as many as fit
    bool whole = false;               ///< outlines of a lattice are made smaller at the border, until they fit
};

/// The patterns' names. Circles and Voronoi cells are even on the surface. Hexagons, triangles, diamonds, stripes and
/// truchet lie in lattices that are even in the domain, and go on over the cut of a ring or a torus. Around a hole of a
/// disk, lattices and circles lie in rows that are concentric in the domain, a bridge away from it and the rim. There
/// stripes follow the circles, and turned by 90 degrees they are rays. On a ring they run from rim to rim, and turned
/// by 90 degrees they go round.
KOEBE_API const std::vector<std::string>& pattern_names();

/// Whether a pattern is the name of a file: by its extension.
KOEBE_API bool is_pattern_file(const std::string& pattern);

struct DrawnPattern {
    std::vector<DrawnOutline> outlines;
    double bend = 1.0;  ///< of the lattice, so that it fits a torus (LaidLattice)
};

/// The sheet's `grade` gives sizes: outlines of a lattice become so much smaller about their middles, and circles and
/// Voronoi cells lie so much nearer to each other. Below least_grade there are no outlines.
/// @param filled the sheet filled (filled_sheet.h): outlines lie beyond the border, too. Null: the sheet itself
/// @throws InputError no such pattern; a size, bridge, turn or repeats that do not fit the surface
DrawnPattern built_in_pattern(const FlatSheet& sheet, const std::string& name, const PatternOptions& options,
                              const FlatSheet* filled = nullptr);

/// On a sphere: circles and Voronoi cells only. @throws InputError as above, and for a lattice
DrawnPattern built_in_pattern_on_sphere(const SphereSheets& sheets, const std::string& name,
                                        const PatternOptions& options);

}  // namespace koebe
