// A surface of genus 0 in flat sheets, by a map to the sphere.
#pragma once

#include "lift/flat_sheet.h"
#include "sphere/spherical_points.h"

#include <optional>
#include <vector>

namespace koebe {

/// A sphere has no flat map without a cut. So a pattern is drawn in stereographic charts that overlap: each shows all
/// but a small cap, and paths cross every edge. In the UVs that are stored, `home`, two disks hold the two halves of
/// the sphere. The charts differ from `home` by a linear map in each face, so that straight lines in a face stay
/// straight.
struct SphereSheets {
    FlatSheet home;         ///< faces of the north in the left half of the unit square, of the south in the right half
    double home_scale = 0;  ///< length in `home` of 1 in the plane of projection, in the middle of a disk
    /// With the north pole, the south pole, and if asked for a vertex in the middle. A place w of the plane of
    /// projection has the UVs (1 + w) / 2. Faces near the opposite point are left out: all their corners lie at 0.
    std::vector<FlatSheet> charts;

    bool in_south(Index face) const { return home.corner(face, 0).real() > 0.5; }
};

/// @param triangles of one orientation @param points (V, 3) unit vectors @param around the vertex of the third chart;
/// its upper side shows to the north pole
/// @throws InputError faces too large on the sphere for the two disks (elements: faces)
SphereSheets sphere_sheets(const Vertices& vertices, const Triangles& triangles, const Vertices& points,
                           std::optional<Index> around);

/// The point of the sphere at a place of `home`.
SpherePoint point_at_home(double home_scale, Complex uv);

/// A place of a chart, in the chart turned so that a middle comes to 0: in the plane of projection. And back.
Complex seen_from(Complex middle, Complex place);
Complex seen_back(Complex middle, Complex seen);
/// Length in the UVs of a chart of a unit length of that turned chart, at the middle.
double magnified(Complex middle);

}  // namespace koebe
