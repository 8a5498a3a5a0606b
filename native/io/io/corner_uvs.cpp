#include "io/corner_uvs.h"

#include <algorithm>
#include <vector>

namespace koebe {
namespace {

constexpr Index no_corner = -1;

class CornerFinder {
public:
    CornerFinder(const PolygonMesh& mesh, const Triangulation& triangulation)
        : mesh_(mesh),
          triangles_(triangulation.triangles),
          source_(mesh.corners.size(), no_corner),
          at_vertex_(static_cast<std::size_t>(mesh.vertices.rows()), no_corner)
    {
        for (Index t = 0; t < static_cast<Index>(triangles_.rows()); ++t)
            for (Index k = 0; k < 3; ++k) take(triangulation.face[static_cast<std::size_t>(t)], 3 * t + k);
        for (Index t = 0; t < static_cast<Index>(triangles_.rows()); ++t)
            for (Index k = 0; k < 3; ++k) take_by_vertex(triangulation.face[static_cast<std::size_t>(t)], 3 * t + k);
        for (Index f = 0; f < mesh_.face_count(); ++f) complete(f);
    }

    /// (C) the triangle corner for each polygon corner, or no_corner.
    const std::vector<Index>& source() const { return source_; }

private:
    /// Takes the corner whose edge to the next corner is the triangle's.
    void take(Index face, Index triangle_corner)
    {
        const Index from = vertex(triangle_corner);
        const Index to = vertex(triangle_corner % 3 == 2 ? triangle_corner - 2 : triangle_corner + 1);
        at_vertex_[from] = triangle_corner;
        const auto polygon = mesh_.face(face);
        for (std::size_t i = 0; i < polygon.size(); ++i)
            if (polygon[i] == from && polygon[(i + 1) % polygon.size()] == to)
                source_[static_cast<std::size_t>(mesh_.face_begin[face]) + i] = triangle_corner;
    }

    /// Takes corners that are named twice in a row.
    void take_by_vertex(Index face, Index triangle_corner)
    {
        const auto polygon = mesh_.face(face);
        for (std::size_t i = 0; i < polygon.size(); ++i)
            if (Index& own = source_[static_cast<std::size_t>(mesh_.face_begin[face]) + i];
                own == no_corner && polygon[i] == vertex(triangle_corner))
                own = triangle_corner;
    }

    void complete(Index face)
    {
        const auto polygon = mesh_.face(face);
        const auto begin = source_.begin() + mesh_.face_begin[face], end = source_.begin() + mesh_.face_begin[face + 1];
        if (std::find(begin, end, no_corner) == end) return;
        const auto met = std::ranges::find_if(polygon, [&](Index v) { return at_vertex_[v] != no_corner; });
        std::fill(begin, end, met == polygon.end() ? no_corner : at_vertex_[*met]);
    }

    Index vertex(Index triangle_corner) const { return triangles_.data()[triangle_corner]; }

    const PolygonMesh& mesh_;
    const Triangles& triangles_;
    std::vector<Index> source_, at_vertex_;
};

}  // namespace

PlanarPoints polygon_corner_uvs(const PolygonMesh& mesh, const Triangulation& triangulation,
                                const PlanarPoints& triangle_uvs)
{
    const CornerFinder finder(mesh, triangulation);
    PlanarPoints uvs = PlanarPoints::Zero(static_cast<Eigen::Index>(mesh.corners.size()), 2);
    for (std::size_t i = 0; i < mesh.corners.size(); ++i)
        if (const Index source = finder.source()[i]; source != no_corner)
            uvs.row(static_cast<Eigen::Index>(i)) = triangle_uvs.row(source);
    return uvs;
}

}  // namespace koebe
