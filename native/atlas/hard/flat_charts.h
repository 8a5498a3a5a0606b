// The charts between a surface's creases, laid flat.
#pragma once

#include "cut/seamed_mesh.h"
#include "flat/flat_part.h"
#include "part_maps/part_mesh.h"

#include <set>
#include <vector>

namespace koebe {

/// A plane motion that keeps orientation.
struct PlaneMotion {
    Complex turn = 1.0, shift = 0.0;
    Complex operator()(Complex z) const { return turn * z + shift; }
};

inline constexpr char bent_edge = 1, loose_edge = 2;

struct FlatCharts {
    SeamedMesh net;            ///< the surface, cut into charts. Edges count as longer where it is shown
    std::vector<Complex> at;   ///< (3F) places of the corners, true to size
    std::vector<char> crease;  ///< (3F) bent_edge where the surface is bent, loose_edge beside loose strips
    std::vector<std::vector<Index>> faces;  ///< of each chart, ascending
    std::vector<FlatPart> parts;            ///< each chart by itself
    std::vector<Index> rest;                ///< faces in no chart, because they are curved in both directions
    std::vector<Index> slits, darts;        ///< half-edges of cuts inside charts, one each
    std::set<Index> tips;                   ///< vertices where darts end
    std::vector<Index> region;              ///< (F) planar region (regions.h)
    std::vector<double> plane;              ///< (F) area of the planar region (regions.h) that a face belongs to
    std::vector<char> plate;  ///< (F) 1 in regions of several faces that are not small, mostly between creases
    double noise = 0.0;       ///< as in PlanarRegions
    double near = 0.0;        ///< places are the same up to this distance
};

/// Cuts the surface along its creases, which are bent by more than an angle, and lays the charts flat, plane by
/// plane: planar regions are similar to their image up to rounding. A chart that closes round a hole, such as the side
/// of a cylinder, is slit, and a chart with a tip, such as a cone, gets a dart. From other charts the plates and the
/// rolled faces between plates are cut out: a fillet, but not a belt of a ball. Their other faces are the rest.
/// A chart that overlaps itself counts as curved. @param most_tips of one chart
/// @param hard_angle in degrees
FlatCharts flat_charts(const CutSurface& surface, std::size_t most_tips, double hard_angle);

}  // namespace koebe
