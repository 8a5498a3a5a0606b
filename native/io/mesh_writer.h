// Mesh files to write: the formats that hold what is written, by the file's extension.
#pragma once

#include "core/warning.h"
#include "io/atomic_file.h"
#include "io/mesh_reader.h"

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

/// The file that a mesh was read from. What else it holds is kept where it has the format that is written.
struct FiledMesh {
    const MeshFile& file;
    bool moved = false;  ///< the mesh that is written has its vertices elsewhere: normals are left out
};

/// The mesh with texture coordinates: write_obj_with_uvs or write_ply_with_uvs.
/// @return what of the file's contents was replaced or not kept: kinds replaced_uvs, not_kept
std::vector<Warning> write_with_uvs(AtomicFile& file, WrittenFormat format, const PolygonMesh& mesh,
                                    const PlanarPoints& disk_points, const FiledMesh& filed);

/// The mesh with texture coordinates of each corner: write_obj_with_corner_uvs or write_ply_with_corner_uvs.
/// @return as write_with_uvs
std::vector<Warning> write_with_corner_uvs(AtomicFile& file, WrittenFormat format, const PolygonMesh& mesh,
                                           const PlanarPoints& corner_uvs, const FiledMesh& filed);

/// The mesh with the numbers of its patches, -1 for none: OBJ groups "surface" and "patch_0", "patch_1", …, or the
/// property `patch` in PLY.
/// @param turned (F) faces of the file that the mesh has in the reverse order
/// @return as write_with_uvs; the file's texture coordinates stay in OBJ
std::vector<Warning> write_with_patches(AtomicFile& file, WrittenFormat format, const PolygonMesh& mesh,
                                        const std::vector<Index>& patch, const std::vector<char>& turned,
                                        const FiledMesh& filed);

}  // namespace koebe
