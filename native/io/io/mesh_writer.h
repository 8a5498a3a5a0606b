// Writes mesh files, in a format chosen by the file's extension.
#pragma once

#include "core/warning.h"
#include "io/atomic_file.h"
#include "io/mesh_reader.h"

#include <filesystem>
#include <optional>
#include <vector>

namespace koebe {

/// OFF and STL are missing: STL has no texture coordinates. Of the readers of STOFF that were tried CGAL 5.5 crashes,
/// MeshLab invents coordinates, trimesh drops them and meshio refuses the file.
enum class WrittenFormat { obj, ply };

/// The format of an extension, in any case. A pipe or device without extension, as /dev/null, takes OBJ.
/// @return nothing for another extension or without extension
std::optional<WrittenFormat> written_format(const std::filesystem::path& target);

/// The file that a mesh was read from. Its other contents are kept if it has the written format.
struct FiledMesh {
    const MeshFile& file;
    bool moved = false;  ///< the written mesh has its vertices elsewhere: normals are left out
};

/// Writes the mesh with texture coordinates by write_obj_with_uvs or write_ply_with_uvs.
/// @return warnings about replaced or lost contents of the file: kinds replaced_uvs, not_kept
std::vector<Warning> write_with_uvs(AtomicFile& file, WrittenFormat format, const PolygonMesh& mesh,
                                    const PlanarPoints& disk_points, const FiledMesh& filed);

/// Writes the mesh with texture coordinates per corner by write_obj_with_corner_uvs or write_ply_with_corner_uvs.
/// @return as write_with_uvs
std::vector<Warning> write_with_corner_uvs(AtomicFile& file, WrittenFormat format, const PolygonMesh& mesh,
                                           const PlanarPoints& corner_uvs, const FiledMesh& filed);

/// Writes the mesh with the numbers of its patches, -1 for no patch: OBJ groups "surface" and "patch_0", "patch_1", …,
/// or the property `patch` in PLY.
/// @return as write_with_uvs; in OBJ the file's texture coordinates stay
std::vector<Warning> write_with_patches(AtomicFile& file, WrittenFormat format, const PolygonMesh& mesh,
                                        const std::vector<Index>& patch, const FiledMesh& filed);

}  // namespace koebe
