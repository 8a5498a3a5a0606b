// Maps surfaces to a flat torus or a cylinder.
#pragma once

#include "circles/mapped_loop.h"
#include "core/api.h"
#include "core/map_options.h"
#include "core/warning.h"
#include "execution/execution.h"
#include "quality/report.h"

#include <array>
#include <vector>

namespace koebe {

/// The shape of a ring's holes.
enum class RingHoles {
    circles,     ///< circles of the round annulus; unrolled, their images
    concentric,  ///< slits along circles round the annulus; unrolled, along u
    radial,      ///< slits along radii; unrolled, along v
};

/// On a torus the change of the circles is measured with its shortest period scaled to 1. EvennessOptions::loops is of
/// the holes.
struct TileOptions : CutDomainOptions, EvennessOptions {
    RingHoles holes = RingHoles::circles;  ///< of a ring
    Index outer = -1, inner = -1;          ///< of a ring: a vertex of each rim; -1: the longest loops
    /// (V) importance of each vertex, 0 to 1, with `even` above 0: faces should be as large beside each other as it
    /// asks for (surface/importance.h). Empty or all equal: no effect.
    std::vector<double> importance = {};
};

/// A loop in the tile.
struct TileLoop : MappedLoop {
    bool rim = false;  ///< of a ring: a straight line from one side of the tile to the other
    bool has_circle = false;
    Circle circle;         ///< in UVs for a torus or a tile made more even, in the unit disk for other rings
    bool is_slit = false;  ///< then off_circle has the vertices off the slit
    std::array<std::array<double, 2>, 2> slit{};  ///< its ends in UVs
};

/// The distortion is measured on the tile, in UV units: 32-bit floats in [0, 1]^2.
struct TileResult : SweptMapReport {
    std::vector<std::array<double, 2>> periods;  ///< in UVs: two for a torus, one along u for a ring
    /// For a torus the ratio of its periods, reduced if the map is conformal. For a ring i times height over period,
    /// log(R / r) / 2 pi.
    Complex modulus;
    std::vector<TileLoop> loops;  ///< by falling length; of a ring the outer and the inner rim come first
    double cut_length = 0.0;      ///< of the cut in the UVs, over the square root of the surface's area
};

/// Maps a surface of genus 1 with any number of holes conformally to a flat torus with round holes. The UVs are a
/// parallelogram of the torus, cut along edges in the UVs only. The two sides of the cut differ by periods to the last
/// bit of 32-bit floats, so copies tile the plane.
/// @throws InputError, TopologyError, SolverError, Cancelled; a map that is not one to one is reported as not converged
KOEBE_API TileResult torus_map(const Vertices& vertices, const Triangles& triangles, const TileOptions& options,
                               ExecutionContext& context);

/// Maps a surface of genus 0 with at least two loops conformally to a cylinder, two loops on its rims, and unrolls it:
/// u runs round, v from the outer rim at 0 to the inner rim. Other holes are images of circles, or slits.
/// @throws as torus_map
KOEBE_API TileResult ring_map(const Vertices& vertices, const Triangles& triangles, const TileOptions& options,
                              ExecutionContext& context);

}  // namespace koebe
