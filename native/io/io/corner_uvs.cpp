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
            for (Index k = 0; k < 3; ++k) take_corner(triangulation.face[static_cast<std::size_t>(t)], 3 * t + k);
        for (Index t = 0; t < static_cast<Index>(triangles_.rows()); ++t)
            for (Index k = 0; k < 3; ++k) take_by_vertex(triangulation.face[static_cast<std::size_t>(t)], 3 * t + k);
        for (Index f = 0; f < mesh_.face_count(); ++f) complete(f);
    }

    /// (C) the triangle corner for each polygon corner, or no_corner.
    const std::vector<Index>& source() const { return source_; }

private:
    /// Takes the corner whose edge to the next corner is the triangle's.
    void take_corner(Index face, Index triangle_corner)
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

PlanarPoints triangle_corner_uvs(const PolygonMesh& mesh, const Triangulation& triangulation,
                                 const PlanarPoints& corner_uvs)
{
    const Triangles& triangles = triangulation.triangles;
    PlanarPoints uvs(triangles.size(), 2);
    for (Index t = 0; t < static_cast<Index>(triangles.rows()); ++t)
        for (int k = 0; k < 3; ++k) {
            // Of a vertex that a polygon names twice, the corner beside the same neighbour.
            const Index before = triangles(t, (k + 2) % 3), after = triangles(t, (k + 1) % 3);
            const auto polygon = mesh.face(triangulation.face[static_cast<std::size_t>(t)]);
            std::size_t best = 0, most = 0;
            for (std::size_t i = 0, n = polygon.size(); i < n; ++i) {
                if (polygon[i] != triangles(t, k)) continue;
                const std::size_t same =
                    1 + (polygon[(i + 1) % n] == after ? 1 : 0) + (polygon[(i + n - 1) % n] == before ? 1 : 0);
                if (same > most) {
                    most = same;
                    best = i;
                }
            }
            const auto begin = mesh.face_begin[triangulation.face[static_cast<std::size_t>(t)]];
            uvs.row(3 * static_cast<Eigen::Index>(t) + k) = corner_uvs.row(begin + static_cast<Index>(best));
        }
    return uvs;
}

}  // namespace koebe
