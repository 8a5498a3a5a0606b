// Lifts a flat pattern onto a surface, through a map of the surface to a flat domain.
#pragma once

#include "core/api.h"
#include "core/map_options.h"
#include "execution/execution.h"
#include "lift/overlay.h"
#include "quality/report.h"

#include <optional>
#include <string>
#include <vector>

namespace koebe {

/// The domain that the pattern is drawn in.
enum class LiftShape { disk, ring, torus, sphere, parts };

KOEBE_API const char* to_string(LiftShape shape) noexcept;

/// What becomes of outlines that meet a hole or a rim of the surface.
enum class LiftRim {
    leave,  ///< they are left out
    clip,   ///< their part on the surface stays
    whole   ///< they are made smaller about their middle, until they fit with a bridge
};

/// Lengths are in the unit of the vertices.
struct LiftOptions {
    LiftShape shape = LiftShape::disk;
    std::optional<double> even = {};    ///< of the map, from 0 to 1; none: 0, and for parts as they choose
    std::optional<double> size = {};    ///< of a cell; none: about twelve across. Of a drawing or mesh its width
    std::optional<double> bridge = {};  ///< between two outlines; none: a fifth of the size. What is cut out is checked
    int repeats = 0;                    ///< round a ring; 0: of a lattice as the size asks for, of a drawing 1
    int seed = 1;                       ///< of circles and Voronoi cells
    double turn = 0.0;                  ///< of a drawing, mesh or lattice, degrees counter-clockwise
    Index around = -1;                  ///< vertex of the hole of a disk that rows follow; of a sphere, the middle of
                                        ///< a drawing or mesh. -1: no hole; the top
    int rows = 0;                       ///< around the hole, beginning there; 0: as many as fit
    LiftRim rim = LiftRim::leave;       ///< of outlines that meet a hole or a rim
    std::vector<double> graded = {};    ///< (V) from 0 to 1: size of built-in outlines there, as a share of `size`
    bool perforate = false;             ///< cut the outlines out
    std::optional<double> height = {};  ///< raise them; below 0: sink them. Of a mesh a factor of its heights
    std::optional<double> thickness = {};  ///< of a closed solid; none: the surface stays a sheet
};

/// `vertex_count` and `face_count` count the result. All figures of a map are for the map that the pattern is drawn in.
struct LiftResult : MapReport {
    Vertices vertices;
    Triangles triangles;
    PlanarPoints uv;              ///< (3F, 2) of corners; walls have no area, and a solid has none
    std::vector<Index> original;  ///< (V) the surface's vertex at the same place, to the last bit; -1: none
    std::vector<Index> patch;     ///< (F) solid: 0 outside, 1 inside, 2 walls; sheet: 0 ground, 1 raised, 2 walls
    std::vector<Index> face;      ///< (F) the surface's face below each; of a wall one at its foot; of a mesh empty
    Vertices weights;             ///< (3F, 3) of corners: where they lie in this face, before they are moved
    LiftShape shape = LiftShape::disk;
    std::string pattern;
    double size = 0.0, bridge = 0.0;  ///< as used
    double bend = 1.0;                ///< of a lattice that fits a torus (LaidLattice)
    Index outlines = 0;               ///< on the surface, each with its holes
    Index crossings = 0;     ///< pairs of faces that meet though they are no neighbours; 0 for a sheet without height
    Index thin_bridges = 0;  ///< pairs of openings that are nearer to each other than `bridge` asks for
    std::optional<double> thinnest_bridge;  ///< of these
    Index islands = 0;                      ///< holes in outlines that are cut out: what was inside has fallen out too
    LeftOut left_out;
    int loops_before = 0, loops_after = 0;  ///< of the sheet; of a mesh only before
    int euler_before = 0, euler_after = 0;  ///< of the sheet; of a mesh only before
};

/// Maps the surface to the domain, draws the pattern's outlines there, and brings them onto the surface: as holes, as a
/// relief, and if asked for as a closed solid. A relief and a solid move vertices of the surface. Otherwise they stay
/// where they are. A hole in an outline of a drawing stays on the ground if the outline is raised, and falls out with
/// it if it is cut out; a warning tells. Outlines that meet a hole or a rim are left out, clipped or made smaller, and
/// those that meet each other are left out. A warning tells how many. If a bridge is asked for, a warning tells where
/// the material between two openings is thinner. A mesh is bent over the surface as it is: its own faces are the
/// result.
///
/// Where a result is raised or thick, distant places of it may meet. A warning tells the faces of the surface there.
/// @param pattern a built-in one (patterns.h), or the name of an SVG (placed_drawing.h), PNG (image_relief.h) or OBJ
/// file (bent_mesh.h)
/// @throws FileError; InputError, TopologyError, SolverError, Cancelled: as the map, and where the result would not be
/// as promised: one hole for each outline, no flipped face, a closed solid
KOEBE_API LiftResult lift(const Vertices& vertices, const Triangles& triangles, const std::string& pattern,
                          const LiftOptions& options, ExecutionContext& context);

}  // namespace koebe
