// Makes a one-to-one map into the plane more even, from conformal to true to size.
#pragma once

#include "core/types.h"
#include "execution/execution.h"
#include "foldover/foldover_free.h"

#include <functional>
#include <vector>

namespace koebe {

/// @throws InputError E is not from 0 to 1
void require_even(double even);

/// The factor by which to scale a map so that its area is the surface's area. @param image_area area of the map
double scale_to_size(const Vertices& vertices, const Triangles& triangles, double image_area);

/// Weight of areas against angles: t = E / (1.1 - E). It is 0 at E = 0, 0.1 at E = 0.1, and 10 at E = 1.
/// @param even E, 0 to 1
double area_weight(double even);

/// Whether a map is an isometry, up to rounding and to `sizes`: no relaxation, and no cut, could make it better.
/// @param sizes (F) as in FlatSurface
bool is_true_to_size(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& points,
                     const VectorXd& sizes = {});

/// Vertices of a loop that stay on a circle or a straight line. The circle or line moves.
struct RoundLoop {
    std::vector<Index> vertices;
    Track track;
};

/// Vertices that springs draw to places.
struct PlacePull {
    std::vector<Index> vertices;
    PlanarPoints places;  ///< (n, 2) in the unit of the points
    double weight = 0.0;  ///< of the square of a distance over the extent; E_t of a conformal map is 0 at E = 0
};

/// A surface and its map. Relaxing changes only the map: points, tracks of `round`, and periods.
struct FlatSurface {
    const Vertices& vertices;              ///< (V, 3) in the unit of the wanted map
    const Triangles& triangles;            ///< (F, 3)
    const std::vector<VertexLoop>& loops;  ///< all boundary loops
    PlanarPoints& points;                  ///< (V, 2) the map, one to one
    std::vector<RoundLoop>& round;         ///< loops that are not free
    /// Only for tiles: how many of each period to add at the corners of faces, and the periods, which are relaxed too.
    /// All loops of a tile are holes. No edge of a loop is lifted.
    CornerLifts lift = {};
    std::vector<Complex>* periods = nullptr;
    /// Refuses steps that leave the domain, for example if circles would meet; empty: refuses no step.
    std::function<bool(const FoldoverPlaces&)> refuses = {};
    VectorXd sizes = {};    ///< (F) factor of the area that each face should have; empty: 1 (surface/importance.h)
    VectorXd weights = {};  ///< (F) factor of each face's energy; empty: 1
    std::vector<Index> held = {};  ///< vertices that stay where they are
    PlacePull pull = {};           ///< vertices that are drawn to places; not for tiles
};

struct EvenEffort {
    int most_steps = 60;     ///< Newton steps at the end, when all faces are near their size
    int most_rounds = 20;    ///< rounds with the void, if loops would cross,
    int most_in_all = 1000;  ///< Newton steps without the void
    int most_far = 0;        ///< and rounds before them, while faces are far from their size
};

struct EvenMap {
    bool moved = false;
    int iterations = 0;  ///< Newton steps
    int rounds = 0;      ///< rounds with the void, triangulated anew in each round
};

/// Minimizes E_t = sum A ((s1^2 + s2^2) / (s1 s2) - 2 + t (s1 s2 + 1 / (s1 s2) - 2)) over the faces. s1 and s2 are the
/// singular values of a face's map, and A is its area, times its factor in `sizes` and its weight. The map is from the
/// face in this size. The first term measures angles (Hormann and Greiner 2000), the second areas (Degener, Meseth and
/// Klein 2003). No step turns a face over, makes circles of round loops meet, or makes loops cross. If a step would
/// make loops cross, the void around the map and in its holes is triangulated and takes part: its faces want to keep
/// their shapes (Jiang, Schaefer and Panozzo 2017).
///
/// A map that is_true_to_size stays as it is, and counts as moved.
/// Faces that are not upright are turned back first (foldover/turn_upright.h). A map that is not one to one even then
/// is not relaxed.
/// @param extent side of the square in which the points are stored as 32-bit floats, in the unit of the points
/// @param pattern kept from the last call with the same triangles and lifts, or an empty one (foldover/newton_system.h)
/// @throws Cancelled
EvenMap make_even(const FlatSurface& surface, double even, double extent, ExecutionContext& context,
                  const EvenEffort& effort = {}, NewtonPattern* pattern = nullptr);

}  // namespace koebe
