// Judges the UVs that readers get: the lost area, and the true angles.
#pragma once

#include "core/api.h"
#include "core/types.h"
#include "quality/angle_error.h"

#include <vector>

namespace koebe {

/// A map as stored: u and v as 32-bit floats, areas in 64 bits.
struct Verdict {
    double lost_area = 0.0;  ///< share of the surface's area in faces without a positive area as stored
    AngleError angle_error_stored_deg;
    std::vector<Index> flipped;           ///< faces without a positive area, ascending
    std::vector<Index> below_resolution;  ///< flipped faces whose longest UV edge is under uv_resolution
};

/// Judges any map by the UVs of its corners, as Blender and files hold them.
///
/// Faces are weighed by their area on the surface; faces without area do not count, and a surface without area loses
/// nothing. Angles are compared as in measure_distortion, lost faces included (angle_errors): a face at one point
/// counts with at least 30 degrees in the mean.
/// @param vertices (V, 3) in any unit @param triangles (F, 3) @param uv (3F, 2) u and v of corner 3 f + k
/// @param turned faces that the map has in the other orientation
/// @param left_out faces that are drawn like others instead of mapped: they are lost only on a line or a point, and
/// have no angles and no flips
KOEBE_API Verdict judge_corners(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& uv,
                                const std::vector<Index>& turned = {}, const std::vector<Index>& left_out = {});

/// Judges a map of the vertices into the unit disk, u = (1 + x) / 2, v = (1 + y) / 2.
/// @param points (V, 2) @param turned as in judge_corners
KOEBE_API Verdict judge_disk(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& points,
                             const std::vector<Index>& turned = {});

/// The flipped faces of a map of the vertices into the unit disk.
std::vector<Index> flipped_faces(const Triangles& triangles, const PlanarPoints& points);

}  // namespace koebe
