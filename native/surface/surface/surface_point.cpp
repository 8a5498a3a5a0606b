#include "surface/surface_point.h"

#include "core/errors.h"
#include "surface/nearest_triangles.h"

#include <string>
#include <utility>

namespace koebe {
namespace {

constexpr double farthest_beside = 0.01;  // distance of a point from the surface, over the diagonal of the bounding box

}  // namespace

std::vector<SurfacePoint> surface_points(const Vertices& vertices, const Triangles& triangles,
                                         const std::vector<NamedPoint>& points)
{
    std::vector<std::pair<Index, int>> corner(vertices.rows(),
                                              {-1, 0});  // a face of each vertex, and the vertex's corner in it
    for (Index f = static_cast<Index>(triangles.rows()) - 1; f >= 0; --f)
        for (int k = 0; k < 3; ++k) corner[triangles(f, k)] = {f, k};
    const auto exists = [&](Index v) { return v < vertices.rows() && corner[v].first >= 0; };

    const auto count = static_cast<Index>(points.size());
    std::vector<Index> missing, far;
    Vertices positions(count, 3);
    for (Index i = 0; i < count; ++i) {
        positions.row(i) = points[i].vertex < 0 ? points[i].position : vertices.row(triangles(0, 0)).eval();
        if (points[i].vertex >= 0 && !exists(points[i].vertex)) missing.push_back(i);
        if (!positions.row(i).allFinite()) far.push_back(i);
    }
    if (!missing.empty())
        throw InputError("landmark " + std::to_string(missing[0]) + ": vertex " +
                             std::to_string(points[missing[0]].vertex) + " belongs to no face of the surface",
                         ElementKind::landmarks, missing);
    PlacesInTriangles places;
    if (far.empty()) {
        places = nearest_triangles(vertices, triangles, positions);
        const double diagonal = (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).norm();
        for (Index i = 0; i < count; ++i)
            if (!(places.distance[i] <= farthest_beside * diagonal)) far.push_back(i);
    }
    if (!far.empty())
        throw InputError("landmark " + std::to_string(far[0]) +
                             ": the point is farther from the surface than 1 % of its size",
                         ElementKind::landmarks, far);
    std::vector<SurfacePoint> found;
    for (Index i = 0; i < count; ++i) {
        const Index v = points[i].vertex;
        if (v >= 0)
            found.push_back({corner[v].first, Eigen::RowVector3d::Unit(corner[v].second)});
        else
            found.push_back({places.face[i], places.weights.row(i)});
    }
    return found;
}

}  // namespace koebe
