#include "surface/nearest_triangles.h"

#include "core/numbering.h"
#include "core/silent_cgal.h"
#include "surface/triangle_tree.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>
#include <vector>

namespace koebe {
namespace {

constexpr double beyond = 1e-9;  // over the largest coordinate

Vertices in_space(const PlanarPoints& points)
{
    Vertices result = Vertices::Zero(points.rows(), 3);
    result.leftCols<2>() = points;
    return result;
}

/// Twice the signed areas of the triangles of p and each edge, with exact signs, for z = 0.
Eigen::RowVector3d planar_weights(const Eigen::RowVector3d& p, const Eigen::Matrix3d& corner)
{
    Eigen::RowVector3d weights;
    for (int k = 0; k < 3; ++k) {
        const Eigen::RowVector3d a = corner.row((k + 1) % 3) - p, b = corner.row((k + 2) % 3) - p;
        weights[k] = a[0] * b[1] - a[1] * b[0];
    }
    return weights;
}

/// The same for p's projection onto the triangle's plane, divided by the normal's length.
Eigen::RowVector3d spatial_weights(const Eigen::RowVector3d& p, const Eigen::Matrix3d& corner)
{
    const Eigen::RowVector3d normal = (corner.row(1) - corner.row(0)).cross(corner.row(2) - corner.row(0));
    Eigen::RowVector3d weights;
    for (int k = 0; k < 3; ++k) {
        const Eigen::RowVector3d a = corner.row((k + 1) % 3) - p, b = corner.row((k + 2) % 3) - p;
        weights[k] = normal.dot(a.cross(b));
    }
    return weights;
}

/// The weight of an edge's end at the edge's point nearest to p.
double share_of_end(const Eigen::RowVector3d& p, const Eigen::RowVector3d& from, const Eigen::RowVector3d& to)
{
    const double squared = (to - from).squaredNorm();
    return squared > 0.0 ? std::clamp((to - from).dot(p - from) / squared, 0.0, 1.0) : 0.0;
}

/// Barycentric coordinates of the point of a triangle that is nearest to p.
/// @param inside weights of p's projection onto the triangle's plane, up to a factor
Eigen::RowVector3d nearest_weights(const Eigen::RowVector3d& p, const Eigen::Matrix3d& corner,
                                   const Eigen::RowVector3d& inside)
{
    const double whole = inside.sum();
    if (whole != 0.0 && (inside / whole).minCoeff() >= 0.0) return inside / whole;
    Eigen::RowVector3d weights = Eigen::RowVector3d::Zero();
    double nearest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
        const Eigen::RowVector3d from = corner.row(k), to = corner.row((k + 1) % 3);
        const double share = share_of_end(p, from, to);
        const double distance = (from + share * (to - from) - p).norm();
        if (!(distance < nearest)) continue;
        nearest = distance;
        weights.setZero();
        weights[k] = 1.0 - share;
        weights[(k + 1) % 3] = share;
    }
    return weights;
}

template <typename InnerWeights>
PlacesInTriangles nearest(const Vertices& corners, const Triangles& triangles, const Vertices& points,
                          InnerWeights&& inner_weights)
{
    const SilentCgal silent;
    std::vector<Index> faces = numbers_below(triangles.rows());
    TriangleTree tree(faces.cbegin(), faces.cend(), corners, triangles);
    tree.accelerate_distance_queries();

    const Eigen::Index count = points.rows();
    PlacesInTriangles places{Eigen::VectorX<Index>(count), Vertices(count, 3), VectorXd(count)};
    const auto corners_of_face = [&](Index face) {
        Eigen::Matrix3d corner;
        for (int k = 0; k < 3; ++k) corner.row(k) = corners.row(triangles(face, k));
        return corner;
    };
    double largest = 0.0;
    for (const Vertices* some : {&corners, &points})
        if (some->size() > 0) largest = std::max(largest, some->cwiseAbs().maxCoeff());
    Index face = 0;
    for (Eigen::Index i = 0; i < count; ++i) {
        const Eigen::RowVector3d p = points.row(i);
        // Beside needles the centroids are far off, and the last face is near: it bounds the search by a point that is
        // slightly farther than the face, so that of equally near faces the same one is found.
        const TreeKernel::Point_3 query(p[0], p[1], p[2]);
        auto hint = tree.best_hint(query);
        const Eigen::Matrix3d last = corners_of_face(face);
        const double bound = (nearest_weights(p, last, inner_weights(p, last)) * last - p).norm() + beyond * largest;
        if (bound * bound < CGAL::squared_distance(query, hint.first))
            hint = {TreeKernel::Point_3(p[0] + bound, p[1], p[2]), face};
        face = tree.closest_point_and_primitive(query, hint).second;
        const Eigen::Matrix3d corner = corners_of_face(face);
        const Eigen::RowVector3d weights = nearest_weights(p, corner, inner_weights(p, corner));
        places.face[i] = face;
        places.weights.row(i) = weights;
        places.distance[i] = (weights * corner - p).norm();
    }
    return places;
}

}  // namespace

Eigen::RowVector3d weights_in_triangle(const Eigen::RowVector3d& point, const Eigen::Matrix3d& corners)
{
    const Eigen::RowVector3d inside = nearest_weights(point, corners, spatial_weights(point, corners));
    const Eigen::RowVector3d at_side = nearest_weights(point, corners, Eigen::RowVector3d::Zero());
    const auto away = [&](const Eigen::RowVector3d& weights) { return (weights * corners - point).squaredNorm(); };
    return away(inside) <= away(at_side) ? inside : at_side;  // of a triangle without area the sides are truer
}

PlacesInTriangles nearest_triangles(const PlanarPoints& corners, const Triangles& triangles, const PlanarPoints& points)
{
    return nearest(in_space(corners), triangles, in_space(points), planar_weights);
}

PlacesInTriangles nearest_triangles(const Vertices& corners, const Triangles& triangles, const Vertices& points)
{
    return nearest(corners, triangles, points, spatial_weights);
}

}  // namespace koebe
