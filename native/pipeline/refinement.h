// A surface whose mesh is too coarse for the iteration, on more triangles.
#pragma once

#include "pipeline/domain.h"

namespace koebe {

/// Every face cut in four at the middles of its edges. The metric stays the same; every boundary vertex gets inner
/// neighbours, so that flux can run through it.
/// @return its first vertices are the domain's; every second vertex of a loop is one of the domain's, in their order
Domain refined_domain(const Domain& domain);

}  // namespace koebe
