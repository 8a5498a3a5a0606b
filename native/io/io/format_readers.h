// One reader for each format, from the file's bytes, called by read_mesh only, which checks indices and coordinates.
// And functions that list a file's contents beside vertices and faces.
#pragma once

#include "io/file_losses.h"
#include "io/mesh_formats.h"
#include "io/polygon_mesh.h"

#include <string_view>
#include <vector>

namespace koebe::io {

PolygonMesh read_obj(std::string_view bytes);
PolygonMesh read_off(std::string_view bytes);
PolygonMesh read_ply(std::string_view bytes);
PolygonMesh read_stl(std::string_view bytes);

// As MeshFormat::corner_uvs (mesh_formats.h).
PlanarPoints obj_corner_uvs(std::string_view bytes, const PolygonMesh& mesh, int set);
PlanarPoints ply_corner_uvs(std::string_view bytes, const PolygonMesh& mesh, int set);
std::vector<Index> obj_corner_marks(std::string_view bytes, CutAt at);  // as MeshFormat::corner_marks

FileLosses obj_contents(std::string_view bytes);
FileLosses off_contents(std::string_view bytes);
FileLosses ply_contents(std::string_view bytes);
FileLosses stl_contents(std::string_view bytes);

}  // namespace koebe::io
