#include "transfer/nearest_triangle.h"

#include "core/silent_cgal.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace koebe {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;

/// A triangle of the mesh in the plane z = 0, by its number.
struct PlanarTriangle {
    using Id = Index;
    using Point = Kernel::Point_3;
    using Datum = Kernel::Triangle_3;

    PlanarTriangle(std::vector<Index>::const_iterator number, const PlanarPoints& of_corners, const Triangles& of_faces)
        : face(*number), corners(&of_corners), triangles(&of_faces)
    {
    }

    Id id() const { return face; }
    Point reference_point() const { return corner(0); }
    Datum datum() const { return {corner(0), corner(1), corner(2)}; }
    Point corner(int k) const
    {
        const Index v = (*triangles)(face, k);
        return {(*corners)(v, 0), (*corners)(v, 1), 0.0};
    }

    Index face;
    const PlanarPoints* corners;
    const Triangles* triangles;
};

using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, PlanarTriangle>>;

Complex at(const PlanarPoints& points, Eigen::Index i) { return {points(i, 0), points(i, 1)}; }

/// Twice the signed area of the triangle a, b, c.
double doubled_area(Complex a, Complex b, Complex c) { return std::imag(std::conj(b - a) * (c - a)); }

/// The weights of the two ends of a segment at its point nearest to p.
double share_of_end(Complex p, Complex from, Complex to)
{
    const double squared = std::norm(to - from);
    return squared > 0.0 ? std::clamp(std::real(std::conj(to - from) * (p - from)) / squared, 0.0, 1.0) : 0.0;
}

/// Barycentric coordinates of the point of a triangle that is nearest to p.
Eigen::RowVector3d nearest_weights(Complex p, const Complex (&corner)[3])
{
    Eigen::RowVector3d weights;
    for (int k = 0; k < 3; ++k) weights[k] = doubled_area(p, corner[(k + 1) % 3], corner[(k + 2) % 3]);
    const double whole = weights.sum();
    if (whole != 0.0 && (weights / whole).minCoeff() >= 0.0) return weights / whole;
    double nearest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
        const Complex from = corner[k], to = corner[(k + 1) % 3];
        const double share = share_of_end(p, from, to);
        const double distance = std::abs(from + share * (to - from) - p);
        if (!(distance < nearest)) continue;
        nearest = distance;
        weights.setZero();
        weights[k] = 1.0 - share;
        weights[(k + 1) % 3] = share;
    }
    return weights;
}

}  // namespace

PlacesInTriangles nearest_triangles(const PlanarPoints& corners, const Triangles& triangles, const PlanarPoints& points)
{
    const SilentCgal silent;
    std::vector<Index> faces(triangles.rows());
    std::iota(faces.begin(), faces.end(), 0);
    Tree tree(faces.cbegin(), faces.cend(), corners, triangles);
    tree.accelerate_distance_queries();

    const Eigen::Index count = points.rows();
    PlacesInTriangles places{Eigen::VectorX<Index>(count), Vertices(count, 3), VectorXd(count)};
    for (Eigen::Index i = 0; i < count; ++i) {
        const Complex p = at(points, i);
        const Index face = tree.closest_point_and_primitive(Point(p.real(), p.imag(), 0.0)).second;
        const Complex corner[3] = {at(corners, triangles(face, 0)), at(corners, triangles(face, 1)),
                                   at(corners, triangles(face, 2))};
        const Eigen::RowVector3d weights = nearest_weights(p, corner);
        places.face[i] = face;
        places.weights.row(i) = weights;
        places.distance[i] = std::abs(weights[0] * corner[0] + weights[1] * corner[1] + weights[2] * corner[2] - p);
    }
    return places;
}

}  // namespace koebe
