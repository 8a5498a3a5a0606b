// Outlines around points of a surface: circles, and the cells of a Voronoi diagram.
#pragma once

#include "lift/flat_sheet.h"
#include "lift/outline.h"
#include "lift/sphere_sheets.h"
#include "surface/surface_point.h"

#include <vector>

namespace koebe {

enum class SiteShape { circles, voronoi };

/// Circles and cells lie in the UVs. The local scale gives their size, so that they are even on the surface. A cell is
/// the site's cell in the Voronoi diagram of all sites and of their mirror images in the vertices of the border, made
/// smaller by half of the bridge. Its corners are round. A circle touches no other circle, and no border.
/// @param size of a cell, bridge between two: lengths on the surface
/// @return an outline for each site that has room
std::vector<DrawnOutline> site_outlines(const FlatSheet& sheet, const std::vector<SurfacePoint>& sites, SiteShape shape,
                                        double size, double bridge);

/// The same on a sphere. Each outline is drawn in the chart whose middle is nearer, as the stereographic chart with the
/// site in the middle shows it.
std::vector<DrawnOutline> site_outlines_on_sphere(const SphereSheets& sheets, const std::vector<SurfacePoint>& sites,
                                                  SiteShape shape, double size, double bridge);

}  // namespace koebe
