// What readers of the stored UVs get: what is lost, and how true the angles are.
#pragma once

#include "core/api.h"
#include "core/types.h"
#include "quality/angle_error.h"

#include <vector>

namespace koebe {

/// A map as it is stored: u and v as 32-bit floats, areas in 64 bits.
struct Verdict {
    double lost_area = 0.0;  ///< share of the surface's area in faces without a positive area as stored
    AngleError angle_error_stored_deg;
    std::vector<Index> flipped;           ///< faces without a positive area, rising
    std::vector<Index> below_resolution;  ///< those of them whose longest UV edge is under uv_resolution
};

/// Judges any map by the UVs of its corners, as Blender and files hold them.
///
/// Faces are weighed by their area on the surface, so those without any do not count; a surface without area loses
/// nothing. Angles are compared as in measure_distortion, faces that are lost included (angle_errors): one that lies on
/// a point counts with 30 degrees at least in the mean.
/// @param vertices (V, 3) in any unit @param triangles (F, 3) @param uv (3F, 2) u and v of corner 3 f + k
/// @param turned faces that the map has in the other orientation
/// @param left_out faces that are not mapped but drawn like others: of these only those that lie on a line or a
/// point are lost, and none has angles or is flipped
KOEBE_API Verdict judge_corners(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& uv,
                                const std::vector<Index>& turned = {}, const std::vector<Index>& left_out = {});

/// The same of a map of the vertices into the unit disk, u = (1 + x) / 2, v = (1 + y) / 2.
/// @param points (V, 2) @param turned as of judge_corners
KOEBE_API Verdict judge_disk(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& points,
                             const std::vector<Index>& turned = {});

/// The flipped faces of a map of the vertices into the unit disk.
std::vector<Index> flipped_faces(const Triangles& triangles, const PlanarPoints& points);

}  // namespace koebe
