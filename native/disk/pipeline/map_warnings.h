// Writes the warnings about a map as sentences.
#pragma once

#include "circles/circle_map.h"
#include "core/warning.h"
#include "ears/ears.h"
#include "foldover/untangle.h"
#include "iteration/koebe_outcome.h"
#include "pipeline/map_input.h"
#include "quality/distortion.h"

#include <vector>

namespace koebe {

/// Warns of circles that are not the surface's own.
std::vector<Warning> circle_warnings(const CircleMap& map);

/// Warns of the input's unused vertices, reoriented faces and thin faces.
std::vector<Warning> input_warnings(const MapInput& whole);

/// Warns of an iteration that failed. @param no_circles whether it led to no map at all
std::vector<Warning> iteration_warnings(const KoebeOutcome& outcome, bool no_circles);

/// Warns of coarse meshes, ears, vertices off their circle, flips and limbs that shrank too far. Each sentence has a
/// number and the input's first element. For regions below the resolution of 32-bit UVs it names the tip of each
/// region, the nearest loop and the size.
std::vector<Warning> flip_warnings(const MapInput& whole, const PlanarPoints& uv, const std::vector<Ear>& ears,
                                   const UntangleReport& untangled, const Distortion& distortion);

}  // namespace koebe
