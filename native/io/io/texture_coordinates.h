// The unit disk in the unit square of textures.
#pragma once

#include "core/errors.h"
#include "io/polygon_mesh.h"

#include <algorithm>

namespace koebe::io {

/// u = (1 + x) / 2 or v = (1 + y) / 2 of a point of the closed unit disk, clamped to [0, 1].
inline double texture_coordinate(double disk_coordinate) { return std::clamp(0.5 * (1.0 + disk_coordinate), 0.0, 1.0); }

/// @throws InputError disk_points does not have one row per vertex
inline void require_point_for_each_vertex(const PolygonMesh& mesh, const PlanarPoints& disk_points)
{
    if (disk_points.rows() != mesh.vertices.rows()) throw InputError("each vertex needs one point of the disk");
}

/// @throws InputError corner_uvs does not have one row per corner
inline void require_point_for_each_corner(const PolygonMesh& mesh, const PlanarPoints& corner_uvs)
{
    if (corner_uvs.rows() != static_cast<Eigen::Index>(mesh.corners.size()))
        throw InputError("each corner needs texture coordinates");
}

}  // namespace koebe::io
