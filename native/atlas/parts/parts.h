// Cuts a surface into disks and tubes with even texels, in the UVs only.
#pragma once

#include "core/api.h"
#include "core/map_options.h"
#include "core/types.h"
#include "execution/execution.h"
#include "part_maps/part_map.h"
#include "pipeline/result.h"

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace koebe {

using CutEdges = std::vector<std::array<Index, 2>>;  ///< edges, as pairs of vertices

struct PartsOptions : MapOptions {
    /// Cost of one more part, in overflow (evenness.h) of a surface of area 1. A cut as long as the root of the area
    /// costs as much. A higher price makes fewer parts. Positive.
    double price = 0.03;
    /// true: any mesh is opened and cut at its handles (cut/open_surface.h). false: other surfaces than uniformize
    /// takes are refused.
    bool cut = true;
    std::vector<Index> polygon = {};  ///< (F) faces with the same number are not cut apart; empty: all may be
    /// A tube is opened along these edges if they lead from one of its loops to the other.
    CutEdges slits = {};
    /// No part goes over one of these edges. An edge inside a polygon, or one that separates nothing, as
    /// it neither leads to a border nor goes on along another cut, does nothing. Needs `cut`.
    CutEdges cuts = {};
    /// (V) from 0 to 1: cuts and darts keep away from vertices of weight 1, where they count as 8 times as long.
    /// Borders (hidden_cuts.h), slits and darts obey. Cuts through handles do not obey. Empty: 0 at all vertices.
    std::vector<double> show = {};
    /// true: rims at cuts lie on circles, and on the straight ends of tubes. false: they follow the surface's edges,
    /// and angles are better.
    bool round_cuts = false;
    /// E, from 0 (conformal) to 1 (true to size), see even/even_map.h. Without a value: the largest E tried at which
    /// the mean angle error is no worse than at E = 0.
    std::optional<double> even = {};
    LoopForm loops = LoopForm::automatic;  ///< form of the surface's own loops, unless even is 0
    /// (V) as in TileOptions, but it needs no `even`. Each part as a whole has the size that it asks for, at any E.
    std::vector<double> importance = {};
    /// Darts (darts.h), from 0 (no darts) to 1 (many). A dart stays if it releases more energy than its length costs:
    /// 1e-4 / darts for the root of the area. At even = 0 there are no darts.
    double darts = 0.015;
    /// Texel density that the parts get, in pixels per unit of the mesh, as the median over the area. Without a value
    /// the parts fill the square.
    std::optional<double> density = {};
    int pixels = 2048;    ///< side of the texture, for `density` and `margin`
    double margin = 8.0;  ///< between two parts, and twice the distance from the border, in pixels
    /// UDIM tiles: parts lie on the squares at u = k mod 10, v = k / 10 for k from 0 to tiles - 1, with one texel
    /// density. 0: as many tiles as `density` needs, at most 100.
    int tiles = 1;
    /// Edges of hard surfaces (hard_surface.h) that are bent by more are creases, in degrees, from 1 to 179. They
    /// are cut, and islands are joined again along straight ones.
    double hard_angle = 30.0;
    bool cut_hard = false;  ///< islands are not joined along creases
    bool roomy = true;      ///< parts are also cut, and islands of hard surfaces left apart, so that they pack well
    bool no_hard = false;   ///< hard surfaces are mapped like all others
    bool rectify = false;   ///< parts that are grids of quadrilaterals become rectangles, whatever their stretch
    bool stack = false;     ///< parts that are copies of another part lie on it (twins.h)
    bool stack_mirrored = false;  ///< parts that are mirror images of another part lie on it
    int threads = 0;              ///< most threads; 0: one for each core. The result is the same for any number
    /// Called with the cuts that are decided so far, on any thread and some times: long before the result, which may
    /// have others. Empty: nobody waits for them
    std::function<void(CutEdges)> sketch = {};
};

struct PartReport {
    PartKind kind = PartKind::disk;
    std::vector<Index> faces;       ///< ascending
    std::vector<VertexLoop> loops;  ///< before a tube is opened, as vertices of the input
    /// The largest distance of each loop from its circle, over the radius. For a tube: the largest distance from the
    /// end of the rectangle, over the end's length for one turn.
    std::vector<double> off_round;
    double angle_error_deg = 0.0;  ///< mean
};

/// A part that lies on another part.
struct StackedPart {
    Index part = 0, onto = 0;
    bool mirrored = false;  ///< it lies there with its back to the front: its faces are turned over as intended
};

/// The UVs lie in [0, 1]^2, or on tiles. Faces of mirrored parts are turned over in them, and count in `flipped` only
/// if they are not. `converged` is true if all parts are one to one, and lose little area as stored
/// (PartsOptions::most_lost).
struct PartsResult : CornerMapReport {
    std::vector<Index> part;  ///< (F) part of each face; -1: in no part: it is degenerate, or doubles another face
    std::vector<PartReport> parts;
    std::vector<StackedPart> stacked;  ///< no part lies on a part of this list
    int tiles = 1;                     ///< tiles that have parts
    double cut_length = 0.0;           ///< length of cuts, slits and darts, over the root of the area
    double slit_length = 0.0;          ///< length of the slits alone
    double dart_length = 0.0;          ///< length of the darts alone
    Index darts = 0;
    int handles_cut = 0;
    double density_ratio_5_95 = 1.0;  ///< texel density at 95 % of the area, over that at 5 %
    double density = 0.0;             ///< texel density that was reached, as in PartsOptions::density
    double even_area = 0.0;           ///< share of the area within the best factor 3 of texel density
    double margin = 0.0;              ///< least distance of two parts, in pixels; many parts get less than the option
    double coverage = 0.0;            ///< share of the unit square, or of the tiles, that the faces cover, as stored
    Index regions = 0;                ///< these three as in hard_figures.h
    double whole = 1.0, aligned = 1.0;
    double maps = 0.0;  ///< number of faces mapped, over the faces of the surface
};

/// Cuts a surface into parts, as long as more even texels are worth more than the part and its cuts cost.
///
/// A part's cost is its overflow (evenness.h): on its circle domain after the most even Moebius map, or on the unrolled
/// tube. Parts are split by minimum cuts of the dual graph, round windows of density and about tips in log polar
/// coordinates. The parent's map judges the children, as circles stay circles. Cuts that do not pay are taken back.
/// Then each part is mapped by itself. All parts get one texel density and are packed.
///
/// @param vertices (V, 3) @param triangles (F, 3) never changed
/// @return every face is in one part; every part is one to one, except for the faces listed in `flipped`
/// @throws InputError, also for a density at which the parts do not fit into the square or the tiles: it names the
/// largest density that fits; TopologyError, SolverError, Cancelled
KOEBE_API PartsResult parts_of(const Vertices& vertices, const Triangles& triangles, const PartsOptions& options,
                               ExecutionContext& context);

}  // namespace koebe
