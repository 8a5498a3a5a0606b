// Lifts a flat pattern onto a surface, through a map of the surface to a flat domain.
#pragma once

#include "core/api.h"
#include "core/map_options.h"
#include "core/option_list.h"
#include "execution/execution.h"
#include "lift/overlay.h"
#include "quality/report.h"

#include <optional>
#include <string>
#include <vector>

namespace koebe {

/// The domain that the pattern is drawn in.
enum class LiftShape { disk, ring, torus, parts };

KOEBE_API const char* to_string(LiftShape shape) noexcept;

/// Lengths are in the unit of the vertices.
struct LiftOptions {
    LiftShape shape = LiftShape::disk;
    std::optional<double> even = {};       ///< of the map, from 0 to 1; none: 0, and for parts as they choose
    std::optional<double> size = {};       ///< of a cell of the pattern; none: about twelve across the surface
    std::optional<double> bridge = {};     ///< between two outlines; none: a fifth of the size
    int repeats = 0;                       ///< of a lattice round a ring; 0: as the size asks for
    int seed = 1;                          ///< of circles and Voronoi cells
    bool perforate = false;                ///< cut the outlines out
    std::optional<double> height = {};     ///< raise them; below 0: sink them
    std::optional<double> thickness = {};  ///< of a closed solid; none: the surface stays a sheet

    KOEBE_OPTIONS(LiftOptions, shape, even, size, bridge, repeats, seed, perforate, height, thickness)
};

/// `vertex_count` and `face_count` are those of the result; what judges a map judges the map that the pattern is drawn
/// in.
struct LiftResult : MapReport {
    Vertices vertices;
    Triangles triangles;
    PlanarPoints uv;              ///< (3F, 2) of corners; walls have no area, and a solid has none
    std::vector<Index> original;  ///< (V) vertex of the surface at the same place, to the last bit; -1: there is none
    std::vector<Index> patch;     ///< (F) of a solid: 0 outside, 1 inside, 2 walls; of a sheet 0, and 1 raised, 2 walls
    LiftShape shape = LiftShape::disk;
    std::string pattern;
    double size = 0.0, bridge = 0.0;  ///< as used
    double bend = 1.0;                ///< of a lattice that fits a torus (LaidLattice)
    Index outlines = 0;               ///< on the surface
    LeftOut left_out;
    int loops_before = 0, loops_after = 0;  ///< of the sheet
    int euler_before = 0, euler_after = 0;  ///< of the sheet
};

/// Maps the surface to the domain, draws the pattern's outlines there, and brings them onto the surface: as holes, as a
/// relief, and if asked for as a closed solid. Vertices of the surface stay where they are, but for a relief's and a
/// solid's. Outlines that meet a hole, a rim or each other are left out, and a warning tells how many.
/// @throws InputError, TopologyError, SolverError, Cancelled: as the map, and where the result would not be as
/// promised: one hole for each outline, no flipped face, a closed solid
KOEBE_API LiftResult lift(const Vertices& vertices, const Triangles& triangles, const std::string& pattern,
                          const LiftOptions& options, ExecutionContext& context);

}  // namespace koebe
