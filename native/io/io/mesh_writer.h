// Writes mesh files, in a format chosen by the file's extension.
#pragma once

#include "core/warning.h"
#include "files/atomic_file.h"
#include "io/mesh_formats.h"
#include "io/mesh_reader.h"

#include <filesystem>
#include <vector>

namespace koebe {

/// The format of a name. A pipe or device without extension, as /dev/null, takes OBJ.
/// @return null if no such format is written
const MeshFormat* written_format(const std::filesystem::path& target);

/// The file that a mesh was read from. Its other contents are kept if it has the written format.
struct FiledMesh {
    const MeshFile& file;
    bool moved = false;  ///< the written mesh has its vertices elsewhere: normals are left out
};

/// Writes the mesh with texture coordinates, a point of the unit disk for each vertex. The format is one that is
/// written.
/// @return warnings about replaced or lost contents of the file: kinds replaced_uvs, not_kept
std::vector<Warning> write_with_uvs(AtomicFile& file, const MeshFormat& format, const PolygonMesh& mesh,
                                    const PlanarPoints& disk_points, const FiledMesh& filed);

/// Writes the mesh with texture coordinates per corner.
/// @return as write_with_uvs
std::vector<Warning> write_with_corner_uvs(AtomicFile& file, const MeshFormat& format, const PolygonMesh& mesh,
                                           const PlanarPoints& corner_uvs, const FiledMesh& filed);

/// Writes the mesh with the numbers of its patches, -1 for no patch: OBJ groups "surface" and "patch_0", "patch_1", …,
/// or the property `patch` in PLY.
/// @return as write_with_uvs; in OBJ the file's texture coordinates stay
std::vector<Warning> write_with_patches(AtomicFile& file, const MeshFormat& format, const PolygonMesh& mesh,
                                        const std::vector<Index>& patch, const FiledMesh& filed);

}  // namespace koebe
