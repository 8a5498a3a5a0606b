#include "circle_domain.h"
#include "core/connectivity.h"
#include "mesh/topology.h"
#include "surface/curvature_weights.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

using namespace koebe;
using namespace koebe::test;

namespace {

IntrinsicMetric metric_of(const Vertices& vertices, const Triangles& triangles)
{
    return intrinsic_metric(vertices, analyze_surface(triangles, static_cast<Index>(vertices.rows())));
}

/// Each edge's factor, (F, 3).
EdgeLengths factors(const IntrinsicMetric& metric, Index count)
{
    return curvature_weights(metric, count).cwiseQuotient(half_cotangents(metric.lengths));
}

}  // namespace

TEST(CurvatureWeights, a_plane_keeps_its_weights_bit_for_bit)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 2000);
    const Vertices flat = lift(domain.points, Lift::plane);
    const IntrinsicMetric metric = metric_of(flat, domain.triangles);
    EXPECT_EQ(curvature_weights(metric, static_cast<Index>(flat.rows())), half_cotangents(metric.lengths));
}

TEST(CurvatureWeights, a_unit_sphere_has_one_plus_a_twelfth_of_the_squared_edge)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 4000);
    const Vertices sphere = lift(domain.points, Lift::sphere);
    const Index count = static_cast<Index>(sphere.rows());
    const IntrinsicMetric metric = metric_of(sphere, domain.triangles);
    const EdgeLengths found = factors(metric, count), exact = 1.0 + metric.lengths.array().square() / 12.0;
    // The defect over the area is K only in the mean of neighbours.
    EXPECT_NEAR((found.array() - 1.0).sum() / (exact.array() - 1.0).sum(), 1.0, 0.01);
    EXPECT_LT(((found - exact).array() / (exact.array() - 1.0)).abs().mean(), 0.1);
}

TEST(CurvatureWeights, do_not_depend_on_the_diagonals_of_quadrilaterals_on_circles)
{
    // A surface of revolution: the four corners between two meridians and two parallels lie on one circle.
    constexpr Index rings = 12, meridians = 17, count = rings * meridians;
    Vertices vase(count, 3);
    for (Index v = 0; v < count; ++v) {
        const Index ring = v / meridians;
        const double angle = 2.0 * std::numbers::pi * (v % meridians) / meridians, radius = 2.0 + std::sin(0.6 * ring);
        vase.row(v) << radius * std::cos(angle), radius * std::sin(angle), 0.5 * ring;
    }
    const auto laplacian = [&](const unsigned seed) {
        std::mt19937 random(seed);
        Triangles faces(2 * (rings - 1) * meridians, 3);
        for (Index i = 0, f = 0; i + 1 < rings; ++i)
            for (Index j = 0; j < meridians; ++j, f += 2) {
                const Index a = i * meridians + j, b = i * meridians + (j + 1) % meridians;
                const Index c = b + meridians, d = a + meridians;
                if (random() % 2)
                    faces.block<2, 3>(f, 0) << a, b, c, a, c, d;
                else
                    faces.block<2, 3>(f, 0) << a, b, d, b, c, d;
            }
        const IntrinsicMetric metric = metric_of(vase, faces);
        return Eigen::MatrixXd(cotan_laplacian(metric.triangles, curvature_weights(metric, count), count));
    };
    EXPECT_LT((laplacian(1) - laplacian(2)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(CurvatureWeights, do_not_depend_on_the_unit_and_vanish_on_rough_surfaces)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 500);
    Vertices rough = lift(domain.points, Lift::enneper);
    std::srand(1);
    rough += 0.05 * Vertices::Random(rough.rows(), 3);
    const Index count = static_cast<Index>(rough.rows());
    const EdgeLengths ratio = factors(metric_of(rough, domain.triangles), count);
    EXPECT_LE((ratio.array() - 1.0).abs().maxCoeff(), 0.0057);  // the most of x / (1 + (x / 0.01)^4)
    EXPECT_GT((ratio.array() - 1.0).abs().maxCoeff(), 0.005);
    for (const double unit : {0x1p-30, 0x1p30})
        EXPECT_LT((factors(metric_of(unit * rough, domain.triangles), count) - ratio).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(CurvatureWeights, a_closed_surface_and_an_unused_vertex_have_finite_weights)
{
    Vertices tetrahedron(5, 3);
    tetrahedron << 1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1, 9, 9, 9;
    Triangles faces(4, 3);
    faces << 0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2;
    IntrinsicMetric metric;
    metric.triangles = faces;
    metric.lengths = edge_lengths(tetrahedron, faces);
    metric.twin = pair_halfedges(faces, 5);
    // Defects of pi: K d^2 is far above what a weight may be corrected by.
    EXPECT_TRUE(factors(metric, 5).isConstant(1.0, 1e-5));
}
