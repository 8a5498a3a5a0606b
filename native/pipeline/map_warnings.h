// What to tell the user: everything out of the ordinary that a map's warnings say, in words.
#pragma once

#include "circles/circle_map.h"
#include "core/warning.h"
#include "flaps/flaps.h"
#include "foldover/untangle.h"
#include "iteration/koebe_outcome.h"
#include "pipeline/map_input.h"
#include "quality/distortion.h"

#include <vector>

namespace koebe {

/// Circles that are not the surface's.
std::vector<Warning> circle_warnings(const CircleMap& map);

/// What the input brought along: vertices of no face, faces that were turned, faces too thin.
std::vector<Warning> input_warnings(const MapInput& whole);

/// An iteration that did not find what it should. @param no_circles whether it led to no map at all
std::vector<Warning> iteration_warnings(const KoebeOutcome& outcome, bool no_circles);

/// Coarse meshes, flaps, freed vertices, flips and limbs that shrank too far. One sentence for each, with its number,
/// the input's first element and, for what shrank below the resolution of 32-bit UVs, each region's place: its tip, the
/// nearest loop and its size.
std::vector<Warning> flip_warnings(const MapInput& whole, const PlanarPoints& uv, const std::vector<Flap>& flaps,
                                   const UntangleReport& untangled, const Distortion& distortion);

}  // namespace koebe
