// Outlines around points of a surface: circles, and the cells of a Voronoi diagram.
#pragma once

#include "lift/flat_sheet.h"
#include "lift/outline.h"
#include "transfer/surface_point.h"

#include <vector>

namespace koebe {

enum class SiteShape { circles, voronoi };

/// Circles and cells lie in the UVs, and are sized by the local scale, so that they are even on the surface. A cell
/// ends at the Voronoi diagram of the sites and of their mirror images in the vertices of the border, less half of the
/// bridge; its corners are round. A circle touches no other circle, and no border.
/// @param size of a cell, bridge between two: lengths on the surface
/// @return an outline for each site that has room
std::vector<DrawnOutline> site_outlines(const FlatSheet& sheet, const std::vector<SurfacePoint>& sites, SiteShape shape,
                                        double size, double bridge);

}  // namespace koebe
