// What a mesh file holds beside the mesh, and the file that is written does not.
#pragma once

#include "core/warning.h"
#include "io/mesh_reader.h"

#include <string>
#include <vector>

namespace koebe::io {

struct FileLosses {
    bool texture_coordinates = false;  ///< those of the file were replaced by new ones
    std::vector<std::string> others;   ///< that are not written: "groups", "vertex property red" ...
};

/// Of a file that is written in another format, or with other vertices than it has: all that the mesh does not hold.
/// @param with_uvs whether new texture coordinates are written
FileLosses losses_of_all(const MeshFile& filed, bool with_uvs);

/// @param moved whether the vertices lie elsewhere
std::vector<Warning> loss_warnings(const FileLosses& losses);

}  // namespace koebe::io
