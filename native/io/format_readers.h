// One reader for each format, from the file's bytes. Called by read_mesh only, which checks what they return.
#pragma once

#include "io/polygon_mesh.h"

#include <array>
#include <string_view>
#include <vector>

namespace koebe::io {

PolygonMesh read_obj(std::string_view bytes);
PolygonMesh read_off(std::string_view bytes);
PolygonMesh read_ply(std::string_view bytes);
PolygonMesh read_stl(std::string_view bytes);

/// Collects what a reader finds, in the order of the file.
class MeshBuilder {
public:
    explicit MeshBuilder(std::size_t expected_vertices = 0, std::size_t expected_faces = 0);
    void add_vertex(const std::array<double, 3>& position) { positions_.push_back(position); }
    void add_corner(Index vertex) { mesh_.corners.push_back(vertex); }
    void end_face() { mesh_.face_begin.push_back(static_cast<Index>(mesh_.corners.size())); }
    std::size_t vertex_count() const { return positions_.size(); }
    /// @throws InputError more vertices or corners than 32-bit indices can name
    PolygonMesh finish();

private:
    std::vector<std::array<double, 3>> positions_;
    PolygonMesh mesh_;
};

/// An index as filed to an Index; what no 32-bit index can name becomes -1, which read_mesh rejects.
constexpr Index to_index(long long filed)
{
    return filed >= 0 && filed <= 0x7fffffffLL ? static_cast<Index>(filed) : Index{-1};
}

}  // namespace koebe::io
