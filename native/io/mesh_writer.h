// Mesh files to write: the formats that hold what is written, by the file's extension.
#pragma once

#include "io/atomic_file.h"
#include "io/polygon_mesh.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace koebe {

/// OFF and STL are not among them: STL has no texture coordinates, and of the readers of STOFF that were tried
/// CGAL 5.5 crashes, MeshLab makes coordinates up, trimesh drops them and meshio refuses the file.
enum class WrittenFormat { obj, ply };

/// By the extension, in any case. A pipe or device without one, as /dev/null, takes OBJ.
/// @return nothing for another extension or none
std::optional<WrittenFormat> written_format(const std::filesystem::path& target);

/// The mesh with texture coordinates: write_obj_with_uvs or write_ply_with_uvs.
void write_with_uvs(AtomicFile& file, WrittenFormat format, const PolygonMesh& mesh, const PlanarPoints& disk_points);

/// The mesh with texture coordinates of each corner: write_obj_with_corner_uvs or write_ply_with_corner_uvs.
void write_with_corner_uvs(AtomicFile& file, WrittenFormat format, const PolygonMesh& mesh,
                           const PlanarPoints& corner_uvs);

/// The mesh with the numbers of its patches, -1 for none: OBJ groups "surface" and "patch_0", "patch_1", …, or the
/// property `patch` in PLY.
void write_with_patches(AtomicFile& file, WrittenFormat format, const PolygonMesh& mesh,
                        const std::vector<Index>& patch);

}  // namespace koebe
