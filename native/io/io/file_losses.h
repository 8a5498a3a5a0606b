// Contents of a mesh file, beside the mesh, that the written file does not hold.
#pragma once

#include "core/warning.h"
#include "io/mesh_reader.h"

#include <string>
#include <vector>

namespace koebe::io {

struct FileLosses {
    bool texture_coordinates = false;  ///< whether the file's were replaced by new ones
    std::vector<std::string> others;   ///< other lost contents: "groups", "vertex property red" ...
};

/// The losses of a file written in another format or with other vertices: all contents beside the mesh.
/// @param with_uvs whether new texture coordinates are written
FileLosses losses_of_all(const MeshFile& filed, bool with_uvs);

/// @param moved whether vertices have other positions
std::vector<Warning> loss_warnings(const FileLosses& losses);

}  // namespace koebe::io
