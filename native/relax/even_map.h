// Any one-to-one map of a surface into the plane, made more even: from conformal to true to size.
#pragma once

#include "core/types.h"
#include "execution/execution.h"
#include "foldover/foldover_free.h"

#include <functional>
#include <vector>

namespace koebe {

/// @throws InputError E is not from 0 to 1
void require_even(double even);

/// What a map is to be scaled by for its area to be the surface's. @param image_area of the map
double scale_to_size(const Vertices& vertices, const Triangles& triangles, double image_area);

/// What areas weigh against angles: t = E / (1.1 - E), 0 at the conformal end, 1/10 of E = 0.1, and 10 at E = 1.
/// @param even E, 0 to 1
double area_weight(double even);

/// Vertices of a loop that stay on one circle or straight line, which moves.
struct RoundLoop {
    std::vector<Index> vertices;
    Track track;
};

/// A surface and its map. What is relaxed is the map alone.
struct FlatSurface {
    const Vertices& vertices;              ///< (V, 3) in the unit that the map is to have
    const Triangles& triangles;            ///< (F, 3)
    const std::vector<VertexLoop>& loops;  ///< all boundary loops
    PlanarPoints& points;                  ///< (V, 2) one to one
    std::vector<RoundLoop>& round;         ///< loops that are not free
    /// Of a tile: how many of each period are added to the places of a face's corners, and the periods, which are
    /// relaxed too. Its loops are holes, of which no edge is lifted.
    CornerLifts lift = {};
    std::vector<Complex>* periods = nullptr;
    /// Refuses steps that leave the domain, as where circles would meet; empty: no step.
    std::function<bool(const FoldoverPlaces&)> refuses = {};
};

struct EvenEffort {
    int most_steps = 60;     ///< of Newton's method at the end, when all faces are near their size
    int most_rounds = 20;    ///< with the void, where loops would cross
    int most_in_all = 1000;  ///< Newton steps, before the void takes part
};

struct EvenMap {
    bool moved = false;
    int iterations = 0;  ///< Newton steps
    int rounds = 0;      ///< of them with the void, which is triangulated anew for each
};

/// Minimizes E_t = sum A ((s1^2 + s2^2) / (s1 s2) - 2 + t (s1 s2 + 1 / (s1 s2) - 2)) over the faces, s1 and s2 the
/// singular values of the face's map and A its area: angles by the first term (Hormann and Greiner 2000), areas by the
/// second (Degener, Meseth and Klein 2003). No step turns a face over, lets circles of round loops meet, or lets a loop
/// cross itself or another: where one would, the void around the map and in its holes is triangulated and takes part,
/// each of its faces to keep its shape (Jiang, Schaefer and Panozzo 2017).
///
/// A map that is not one to one to begin with is left as it is.
/// @param extent of the square that the points are stored in as 32-bit floats, in their unit
/// @throws Cancelled
EvenMap make_even(const FlatSurface& surface, double even, double extent, ExecutionContext& context,
                  const EvenEffort& effort = {});

}  // namespace koebe
