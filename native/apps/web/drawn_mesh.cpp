#include "web/drawn_mesh.h"

#include "files/text_lines.h"
#include "io/mesh_reader.h"
#include "io/polygon_triangulation.h"

#include <algorithm>
#include <cstddef>

#include <emscripten.h>

namespace koebe::web {
namespace {

/// The number of a polygon's corner at a vertex.
std::size_t corner_at(const PolygonMesh& mesh, Index face, Index vertex)
{
    const auto corners = mesh.face(face);
    return static_cast<std::size_t>(mesh.face_begin[face] + (std::ranges::find(corners, vertex) - corners.begin()));
}

DrawnMesh drawn;  // what the page reads

}  // namespace

std::vector<float> written_uvs(std::string_view bytes, std::size_t corner_count)
{
    std::vector<double> points;
    std::vector<float> uvs;
    io::TextLines lines(bytes);
    while (lines.next_statement()) {
        const std::string_view keyword = lines.next_word_of_joined_lines();
        if (keyword == "vt") {
            for (int axis = 0; axis < 2; ++axis)
                if (!io::to_number(lines.next_word_of_joined_lines(), points.emplace_back())) return {};
        } else if (keyword == "f") {
            for (std::string_view word; !(word = lines.next_word_of_joined_lines()).empty();) {
                word.remove_prefix(std::min(word.find('/'), word.size() - 1) + 1);
                Index number = 0;  // counted from 1
                if (!io::to_number(word.substr(0, word.find('/')), number) || number < 1 ||
                    static_cast<std::size_t>(number) > points.size() / 2)
                    return {};
                for (int axis = 0; axis < 2; ++axis)
                    uvs.push_back(static_cast<float>(points[2 * static_cast<std::size_t>(number - 1) + axis]));
            }
        }
    }
    return uvs.size() == 2 * corner_count ? uvs : std::vector<float>{};
}

DrawnMesh read_drawn_mesh(const std::filesystem::path& path)
{
    const MeshFile file = read_mesh_file(path);
    const PolygonMesh mesh = parse_mesh(file.bytes, file.extension);
    const Triangulation triangulation = triangulate(mesh, false);
    const std::vector<float> uvs =
        file.extension == ".obj" ? written_uvs(file.bytes, mesh.corners.size()) : std::vector<float>{};
    DrawnMesh result;
    result.positions.assign(mesh.vertices.data(), mesh.vertices.data() + mesh.vertices.size());
    result.faces = triangulation.face;
    for (Index t = 0; t < triangulation.triangles.rows(); ++t)
        for (const Index v : triangulation.triangles.row(t)) {
            result.corners.push_back(v);
            if (uvs.empty()) continue;
            const std::size_t corner = corner_at(mesh, result.faces[static_cast<std::size_t>(t)], v);
            result.uvs.insert(result.uvs.end(), {uvs[2 * corner], uvs[2 * corner + 1]});
        }
    return result;
}

// What the page calls.
extern "C" {

/// Reads a file for the arrays below. @return false: it cannot be read
EMSCRIPTEN_KEEPALIVE bool koebe_draw(const char* path)
{
    try {
        drawn = read_drawn_mesh(path);
        return true;
    } catch (const std::exception&) {  // the command says why
        return false;
    }
}

EMSCRIPTEN_KEEPALIVE const float* koebe_positions() { return drawn.positions.data(); }
EMSCRIPTEN_KEEPALIVE const Index* koebe_corners() { return drawn.corners.data(); }
EMSCRIPTEN_KEEPALIVE const Index* koebe_faces() { return drawn.faces.data(); }
EMSCRIPTEN_KEEPALIVE const float* koebe_uvs() { return drawn.uvs.data(); }
EMSCRIPTEN_KEEPALIVE std::size_t koebe_vertex_count() { return drawn.positions.size() / 3; }
EMSCRIPTEN_KEEPALIVE std::size_t koebe_triangle_count() { return drawn.faces.size(); }
EMSCRIPTEN_KEEPALIVE bool koebe_has_uvs() { return !drawn.uvs.empty(); }

}  // extern "C"

}  // namespace koebe::web
