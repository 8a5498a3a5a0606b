// OBJ files: the polygons as they were filed, with texture coordinates or groups.
#pragma once

#include "io/atomic_file.h"
#include "io/polygon_mesh.h"

#include <string>
#include <vector>

namespace koebe {

/// Writes the mesh with one `vt` for each vertex: u = (1 + x) / 2, v = (1 + y) / 2, clamped to [0, 1]. All numbers
/// are the shortest that read back to the same 64-bit float. The caller commits the file.
/// @param disk_points (V, 2) points of the closed unit disk
/// @throws InputError disk_points has not one row for each vertex
/// @throws FileError
void write_obj_with_uvs(AtomicFile& file, const PolygonMesh& mesh, const PlanarPoints& disk_points);

/// Writes the mesh with texture coordinates of its corners: a `vt` for each place that a vertex has, in the order of
/// the faces. The caller commits the file.
/// @param corner_uv (C, 2) of mesh.corners, in [0, 1]
/// @throws InputError corner_uv has not one row for each corner
/// @throws FileError
void write_obj_with_corner_uvs(AtomicFile& file, const PolygonMesh& mesh, const PlanarPoints& corner_uv);

/// Writes the mesh with a `g` line wherever the group changes from face to face. The caller commits the file.
/// @param group (F) of each face, an index into names
/// @throws FileError
void write_obj_with_groups(AtomicFile& file, const PolygonMesh& mesh, const std::vector<Index>& group,
                           const std::vector<std::string>& names);

}  // namespace koebe
