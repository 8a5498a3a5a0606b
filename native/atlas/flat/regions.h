// Planar regions of a surface: neighbouring faces in one plane, however they are triangulated.
#pragma once

#include "core/types.h"
#include "part_maps/part_mesh.h"

#include <vector>

namespace koebe {

/// A plane with a frame, in which a region is true to shape.
struct RegionPlane {
    Eigen::RowVector3d origin, right, up, normal;  ///< right, up and normal: an orthonormal frame
    double area = 0.0;                             ///< of the region's faces

    Complex place(const Eigen::RowVector3d& point) const
    {
        return {(point - origin).dot(right), (point - origin).dot(up)};
    }
};

/// Of a face's area: a plane that is no larger holds no other face.
inline constexpr double alone = 1.0 + 1e-9;

/// Of the noise: how far single faces of a region may lie off its plane.
inline constexpr double noise_reach = 3.0;

struct PlanarRegions {
    std::vector<Index> of;            ///< (F) region of each face
    std::vector<RegionPlane> planes;  ///< (regions)
    double tolerance = 0.0;           ///< the largest distance of a vertex from its plane
    double noise = 0.0;               ///< the tolerance, if it is that of noise; else 0
};

/// Each region grows from its largest face over all neighbours whose vertices lie near its plane. The plane is fitted
/// again until the region stops to grow. So thin faces, whose own normals are only rounding, belong to the plane around
/// them. @param tolerance the largest distance of a vertex from its plane @param is_noise the tolerance is that of
/// noise
PlanarRegions regions_within(const CutSurface& surface, double tolerance, bool is_noise);

}  // namespace koebe
