// Writes OBJ files: the polygons as filed, with texture coordinates or groups, and the file's other contents.
#pragma once

#include "files/atomic_file.h"
#include "io/file_losses.h"
#include "io/filed_text.h"
#include "io/polygon_mesh.h"

#include <string>
#include <vector>

namespace koebe {

/// Writes the mesh with one `vt` for each vertex: u = (1 + x) / 2, v = (1 + y) / 2, clamped to [0, 1]. New numbers
/// are the shortest that read back to the same 64-bit float. The caller commits the file.
///
/// All contents of a filed OBJ file are written again unchanged, except for texture coordinates: they are replaced, and
/// left out in `l`.
/// @param disk_points (V, 2) points of the closed unit disk
/// @throws InputError disk_points does not have one row per vertex
/// @throws FileError
io::FileLosses write_obj_with_uvs(AtomicFile& file, const PolygonMesh& mesh, const PlanarPoints& disk_points,
                                  const FiledText& filed = {});

/// Writes the mesh with a `vt` for each place of a vertex: corners of one vertex at one place share it.
/// @param corner_uvs (C, 2) in [0, 1]^2, in the order of mesh.corners
/// @throws InputError corner_uvs does not have one row per corner
/// @throws FileError
io::FileLosses write_obj_with_corner_uvs(AtomicFile& file, const PolygonMesh& mesh, const PlanarPoints& corner_uvs,
                                         const FiledText& filed = {});

/// Writes the mesh with a `g` line wherever the group changes from face to face. The caller commits the file. The mesh
/// may have more vertices and faces than the text, after the text's own. If the text has groups or objects, its faces
/// stay in them, and only the other faces get the groups of this call.
/// @param group (F) of each face, an index into names
/// @param filed its texture coordinates stay
/// @throws FileError
void write_obj_with_groups(AtomicFile& file, const PolygonMesh& mesh, const std::vector<Index>& group,
                           const std::vector<std::string>& names, const FiledText& filed = {});

}  // namespace koebe
