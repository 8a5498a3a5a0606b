// Moves vertices of a flat map to given places; the rest of the map follows.
#pragma once

#include "core/types.h"
#include "even/even_map.h"
#include "execution/execution.h"

#include <vector>

namespace koebe {

/// Vertices with places of their own.
struct Pins {
    std::vector<Index> vertices;
    PlanarPoints places;  ///< (n, 2)

    Eigen::Index count() const { return places.rows(); }
};

/// @throws InputError pins that are no vertices, twice the same, not finite, or at one place; a face with three pins
/// that is turned over
void require_pins(const Pins& pins, const Triangles& triangles, Eigen::Index vertices);

/// z -> factor z + shift.
struct PinPlacement {
    Complex factor{1.0, 0.0}, shift;

    Complex operator()(Complex z) const { return factor * z + shift; }
};

/// The similarity that puts one pin or two pins in their places, and more than two near them: these turn as least
/// squares say, and get the size at which they are as far from their middle as their places are. One pin only moves.
PinPlacement placement_at_pins(const Pins& pins, const PlanarPoints& points);

/// Draws the pins to their places by springs (PlacePull) that become stiffer, until they can be put there without
/// turning a face over. No step turns a face over or makes loops cross, so the map stays one to one.
/// @param surface the map, one to one; its points move
/// @param even E, above 0 @param extent as in make_even
/// @return pins (numbers of rows) that are not at their places: none if all are; then all other vertices may relax
/// further, with the pins in `held`
/// @throws Cancelled
std::vector<Index> draw_to_pins(const FlatSurface& surface, const Pins& pins, double even, double extent,
                                ExecutionContext& context, NewtonPattern* pattern);

}  // namespace koebe
