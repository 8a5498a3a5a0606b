// A surface cut in the UVs alone into parts of even texels: disks and tubes.
#pragma once

#include "core/api.h"
#include "core/map_options.h"
#include "core/types.h"
#include "evenness/part_map.h"
#include "execution/execution.h"
#include "pipeline/result.h"

#include <array>
#include <optional>
#include <vector>

namespace koebe {

struct PartsOptions : MapOptions {
    /// What a part costs, in area share times the u that lies outside the even window; a cut as long as the root of the
    /// area costs as much. Higher: fewer parts. Positive.
    double price = 0.0037;
    /// Any mesh, opened and cut at its handles (cut/open_surface.h); false: only what uniformize takes.
    bool cut = true;
    std::vector<Index> polygon = {};  ///< (F) faces of one number are not cut apart; empty: each is one by itself
    /// Edges, by their vertices, along which a tube is opened where they lead from one of its loops to the other.
    std::vector<std::array<Index, 2>> slits = {};
    /// Rims at cuts lie on circles, and on the straight ends of tubes. false: they follow the surface's edges, which
    /// costs no angles.
    bool round_cuts = false;
    /// From 0, conformal, to 1, true to size (relax/even_map.h); none: the largest of some at which the mean angle
    /// error is no worse than at 0.
    std::optional<double> even = {};
    LoopForm loops = LoopForm::automatic;  ///< of the surface's own loops, unless even is 0; free, but with round_cuts
    /// Cuts from a rim at a cut into a part (darts.h), where the energy that they release pays for their length at a
    /// price of 1e-4 / darts for the root of the area: from 0, none, to 1, many. There are none where even is 0.
    double darts = 0.2;
    int threads = 0;  ///< at most; 0: as many as the machine has. The result is the same for any number

    template <typename Visit>
    static void each_option(Visit&& visit)
    {
        visit("price", &PartsOptions::price);
        visit("even", &PartsOptions::even);
        visit("loops", &PartsOptions::loops);
        visit("darts", &PartsOptions::darts);
        visit("round_cuts", &PartsOptions::round_cuts);
        MapOptions::each_option(visit);
        visit("cut", &PartsOptions::cut);
        visit("polygon", &PartsOptions::polygon);
        visit("slits", &PartsOptions::slits);
    }
};

struct PartReport {
    PartKind kind = PartKind::disk;
    std::vector<Index> faces;       ///< rising
    std::vector<VertexLoop> loops;  ///< before a tube is opened; by vertices of the input
    /// Of each loop: how far it is from the circle of a disk, or the end of a tube's rectangle, at most; over the
    /// circle's radius, or the end's length over a turn.
    std::vector<double> off_round;
    double angle_error_deg = 0.0;  ///< mean
};

/// Converged are parts that are one to one, and lose little as stored (PartsOptions::most_lost). The UVs lie in
/// [0, 1]^2.
struct PartsResult : CornerMapReport {
    std::vector<Index> part;  ///< (F) of each face; -1: in none, as it is degenerate or the double of another
    std::vector<PartReport> parts;
    double cut_length = 0.0;   ///< of cuts and slits, over the root of the area
    double slit_length = 0.0;  ///< of the slits among them,
    double dart_length = 0.0;  ///< and of the darts
    Index darts = 0;
    int handles_cut = 0;
    double density_ratio_5_95 = 1.0;  ///< texel density, 95 % over 5 % of the area
    double even_area = 0.0;           ///< share of the area within the best factor 3 of texel density
    double coverage = 0.0;            ///< share of the unit square that the faces cover, as stored
    double maps = 0.0;                ///< faces mapped, in faces of the surface
};

/// Cuts a surface into parts where that makes texels more even than a part and its cuts cost.
///
/// A part's cost is its overflow (evenness.h) on the circle domain of the most even Moebius map, or on the unrolled
/// tube. The costliest is split by minimum cuts of the dual graph round windows of density and about tips, in log polar
/// coordinates; children are judged by the parent's map, as circles stay circles; cuts that do not pay are taken back.
/// Each part is then mapped by itself, all are brought to one texel density and packed.
///
/// @param vertices (V, 3) @param triangles (F, 3) never changed
/// @return every face in one part, every part one to one but for the faces that `flipped` lists
/// @throws InputError, TopologyError, SolverError, Cancelled
KOEBE_API PartsResult parts_of(const Vertices& vertices, const Triangles& triangles, const PartsOptions& options,
                               ExecutionContext& context);

}  // namespace koebe
