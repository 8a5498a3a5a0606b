// Points spread evenly over a surface.
#pragma once

#include "lift/flat_sheet.h"
#include "surface/surface_point.h"

#include <cstdint>
#include <vector>

namespace koebe {

/// Outlines that would be smaller than this share of the size are not drawn.
inline constexpr double least_grade = 0.1;

/// Lloyd's iteration [Lloyd 1982] on a dense random sample of the surface, with distances in space; points whose
/// normals differ are farther apart, so that the two sides of a thin wall do not mix. The same seed gives the same
/// points.
/// @param spacing of neighbours on the surface, in the unit of the vertices; where the sheet has a grade, times that.
/// No points lie where the grade is below least_grade
/// @throws InputError more than a million points; no part of the surface has a grade
std::vector<SurfacePoint> even_sites(const FlatSheet& sheet, double spacing, std::uint64_t seed);

}  // namespace koebe
