// One reader for each format, from the file's bytes: CGAL's, and what it leaves unchecked. Called by read_mesh only,
// which checks the indices and the coordinates.
#pragma once

#include "io/polygon_mesh.h"

#include <string>

namespace koebe::io {

PolygonMesh read_obj(std::string bytes);
PolygonMesh read_off(std::string bytes);
PolygonMesh read_ply(std::string bytes);
PolygonMesh read_stl(std::string bytes);

}  // namespace koebe::io
