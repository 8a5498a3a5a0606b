#include "surface/nearest_triangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

using namespace koebe;

/// The last face bounds each search: points go to and fro, from near to far beyond all coordinates.
TEST(NearestTriangles, no_triangle_of_a_ring_of_needles_is_nearer)
{
    constexpr Index around = 200;
    Vertices corners(2 * around, 3);
    Triangles triangles(2 * around, 3);
    for (Index i = 0; i < around; ++i) {
        const double turn = 2.0 * std::numbers::pi * i / around;
        corners.row(i) << std::cos(turn), std::sin(turn), 0.3 * std::cos(3.0 * turn);
        corners.row(around + i) << 2.0 * std::cos(turn), 2.0 * std::sin(turn), 0.0;
        const Index next = (i + 1) % around;
        triangles.row(2 * i) << i, around + i, around + next;
        triangles.row(2 * i + 1) << i, around + next, next;
    }
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    Vertices points(600, 3);
    for (Eigen::Index i = 0; i < points.rows(); ++i)
        for (int k = 0; k < 3; ++k) points(i, k) = normal(random) * std::pow(10.0, i % 7 == 6 ? 12 : 0);
    points.topRows(100) = corners.topRows(100);
    const PlacesInTriangles places = nearest_triangles(corners, triangles, points);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
        const Eigen::RowVector3d p = points.row(i);
        double nearest = std::numeric_limits<double>::infinity();
        for (Index f = 0; f < triangles.rows(); ++f) {
            const Eigen::Matrix3d at = corners(Eigen::ArrayXi(triangles.row(f)), Eigen::all);
            nearest = std::min(nearest, (weights_in_triangle(p, at) * at - p).norm());
        }
        EXPECT_NEAR(places.distance[i], nearest, 1e-12 * (1.0 + p.norm())) << i;
    }
}
