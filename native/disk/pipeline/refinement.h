// Refines a surface whose mesh is too coarse for the iteration.
#pragma once

#include "pipeline/map_input.h"

namespace koebe {

/// Cuts every face in four at the middles of its edges. The metric stays the same. Every boundary vertex gets inner
/// neighbours, so that flux can run through it.
/// @return its first vertices are the surface's; every second vertex of a loop is the surface's, in the same order
MapInput refined_input(const MapInput& input);

}  // namespace koebe
