// Writes PLY files as text: the polygons of the input file, with texture coordinates or patch numbers, and the other
// contents of the input file.
#pragma once

#include "files/atomic_file.h"
#include "io/file_losses.h"
#include "io/filed_text.h"
#include "io/polygon_mesh.h"

#include <vector>

namespace koebe {

/// Writes the mesh with u = (1 + x) / 2, v = (1 + y) / 2 of each vertex, clamped to [0, 1], under both pairs of names
/// that programs read: s and t (Blender), texture_u and texture_v (MeshLab, VTK). All numbers are the shortest that
/// read back to the same 64-bit float. The file is text, as readers in use (trimesh, meshio) refuse binary files of
/// polygons with different numbers of corners. The caller commits the file.
///
/// Comments, other elements and other properties of vertices and faces of a filed PLY file are written again, as text;
/// only texture coordinates are replaced.
/// @param disk_points (V, 2) points of the closed unit disk
/// @throws InputError disk_points does not have one row per vertex
/// @throws FileError
io::FileLosses write_ply_with_uvs(AtomicFile& file, const PolygonMesh& mesh, const PlanarPoints& disk_points,
                                  const FiledText& filed = {});

/// Writes the mesh with the list property `texcoord` of each face: u and v of its corners, as in MeshLab.
/// @param corner_uvs (C, 2) in [0, 1]^2, in the order of mesh.corners
/// @throws InputError corner_uvs does not have one row per corner
/// @throws FileError
io::FileLosses write_ply_with_corner_uvs(AtomicFile& file, const PolygonMesh& mesh, const PlanarPoints& corner_uvs,
                                         const FiledText& filed = {});

/// Writes the mesh with the property `patch` for each face. The caller commits the file.
/// @param patch (F) number of each face's patch, -1 for no patch
/// @throws FileError
void write_ply_with_patches(AtomicFile& file, const PolygonMesh& mesh, const std::vector<Index>& patch);

}  // namespace koebe
