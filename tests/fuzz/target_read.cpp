#include "promise_check.h"
#include "targets.h"

#include "core/errors.h"
#include "io/mesh_reader.h"
#include "io/polygon_triangulation.h"

#include <algorithm>
#include <iterator>

namespace koebe::fuzz {
namespace {

constexpr const char* extensions[] = {".obj", ".off", ".ply", ".stl"};

void check_mesh(const PolygonMesh& mesh)
{
    require(mesh.vertices.rows() > 0 && mesh.face_count() > 0, "a mesh that was read has vertices and faces");
    require(mesh.vertices.allFinite(), "coordinates that were read are finite");
    require(std::ranges::is_sorted(mesh.face_begin) && mesh.face_begin.front() == 0 &&
                mesh.face_begin.back() == static_cast<Index>(mesh.corners.size()),
            "faces follow each other");
    require(std::ranges::all_of(mesh.corners, [&](Index v) { return v >= 0 && v < mesh.vertices.rows(); }),
            "corners that were read exist");
}

void check_triangulation(const PolygonMesh& mesh, const Triangulation& cut)
{
    require(cut.face.size() == static_cast<std::size_t>(cut.triangles.rows()), "every triangle has its face");
    for (Eigen::Index t = 0; t < cut.triangles.rows(); ++t) {
        const auto face = mesh.face(cut.face[t]);
        for (int k = 0; k < 3; ++k)
            require(std::ranges::find(face, cut.triangles(t, k)) != face.end(),
                    "a triangle is made of its face's corners");
    }
    require(std::ranges::is_sorted(cut.face), "triangles follow the order of the faces");
}

}  // namespace

void fuzz_read(Bytes bytes)
{
    if (bytes.empty()) return;
    const char* extension = extensions[bytes[0] % std::size(extensions)];
    const std::string_view file(reinterpret_cast<const char*>(bytes.data()) + 1, bytes.size() - 1);
    try {
        const PolygonMesh mesh = parse_mesh(file, extension);
        check_mesh(mesh);
        check_triangulation(mesh, triangulate(mesh));
    } catch (const KoebeError&) {
    }
}

}  // namespace koebe::fuzz
