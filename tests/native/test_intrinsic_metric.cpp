#include "circle_domain.h"
#include "core/connectivity.h"
#include "surface/intrinsic_metric.h"
#include "surface/one_form.h"

#include <gtest/gtest.h>

using namespace koebe;
using namespace koebe::test;

namespace {

double total_area(const IntrinsicMetric& metric)
{
    double area = 0.0;
    for (Eigen::Index f = 0; f < metric.lengths.rows(); ++f)
        area += triangle_area(metric.lengths(f, 0), metric.lengths(f, 1), metric.lengths(f, 2));
    return area;
}

/// A flat grid sheared so that half its edges are not Delaunay.
struct Sheared {
    Vertices vertices;
    Triangles triangles;
};

Sheared sheared_grid(Index n)
{
    Sheared mesh{Vertices(n * n, 3), Triangles(2 * (n - 1) * (n - 1), 3)};
    for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j) mesh.vertices.row(i * n + j) << i + 1.7 * j, j, 0.0;
    Index f = 0;
    for (Index i = 0; i + 1 < n; ++i)
        for (Index j = 0; j + 1 < n; ++j) {
            const Index a = i * n + j, b = a + n, c = b + 1, d = a + 1;
            mesh.triangles.row(f++) << a, b, c;
            mesh.triangles.row(f++) << a, c, d;
        }
    return mesh;
}

}  // namespace

TEST(IntrinsicMetric, leaves_a_delaunay_mesh_of_good_triangles_alone)
{
    const CircleDomain domain = make_circle_domain({Circle{}}, 500);
    const Vertices plane = lift(domain.points, Lift::plane);
    const Surface surface = analyze_surface(domain.triangles, static_cast<Index>(plane.rows()));
    const IntrinsicMetric metric = intrinsic_metric(plane, surface);
    EXPECT_EQ(metric.flips.size(), 0u);
    EXPECT_EQ(metric.mollification, 0.0);
    EXPECT_EQ(metric.triangles, surface.triangles);
}

TEST(IntrinsicMetric, carries_closed_forms_over_flips)
{
    const Sheared mesh = sheared_grid(12);
    const Surface surface = analyze_surface(mesh.triangles, static_cast<Index>(mesh.vertices.rows()));
    // Whole numbers, so that sums are exact.
    VectorXd f(surface.vertex_count);
    for (Index v = 0; v < surface.vertex_count; ++v) f[v] = static_cast<double>((v * 7919) % 101);
    std::vector<OneForm> carried{exterior_derivative(surface.triangles, f),
                                 exterior_derivative(surface.triangles, f.cwiseAbs2())};
    const IntrinsicMetric metric = intrinsic_metric(mesh.vertices, surface, {}, &carried);
    EXPECT_GT(metric.flips.size(), 50u);
    EXPECT_EQ(carried[0], exterior_derivative(metric.triangles, f));
    EXPECT_EQ(carried[1], exterior_derivative(metric.triangles, f.cwiseAbs2()));
}

TEST(IntrinsicMetric, flips_keep_the_area_and_make_inner_weights_nonnegative)
{
    const Sheared mesh = sheared_grid(12);
    const Surface surface = analyze_surface(mesh.triangles, static_cast<Index>(mesh.vertices.rows()));
    const IntrinsicMetric before = intrinsic_metric(mesh.vertices, surface, {.delaunay = false});
    const IntrinsicMetric after = intrinsic_metric(mesh.vertices, surface);
    EXPECT_GT(after.flips.size(), 50u);
    EXPECT_NEAR(total_area(after) / total_area(before), 1.0, 1e-11);
    // Flat, so each length is still the distance of its ends.
    for (Eigen::Index f = 0; f < after.lengths.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            ASSERT_NEAR(
                after.lengths(f, k),
                (mesh.vertices.row(after.triangles(f, k)) - mesh.vertices.row(after.triangles(f, (k + 1) % 3))).norm(),
                1e-9);
    // Left as they are only where the new edge would join two vertices of the loop.
    const std::vector<char> rim = boundary_mask(surface);
    const auto flippable = [&](const IntrinsicMetric& metric) {
        const EdgeLengths weights = half_cotangents(metric.lengths);
        const std::vector<Index> twin = pair_halfedges(metric.triangles, surface.vertex_count);
        int count = 0;
        for (Index h = 0; h < metric.triangles.size(); ++h) {
            if (twin[h] == no_twin || weights.data()[h] + weights.data()[twin[h]] > -1e-8) continue;
            count += !(rim[target(metric.triangles, next_halfedge(h))] &&
                       rim[target(metric.triangles, next_halfedge(twin[h]))]);
        }
        return count;
    };
    EXPECT_GT(flippable(before), 0);
    EXPECT_EQ(flippable(after), 0);
    // An Euler characteristic that holds, so the flips are real triangulations.
    EXPECT_EQ(analyze_surface(after.triangles, surface.vertex_count).euler_characteristic,
              surface.euler_characteristic);
}

TEST(IntrinsicMetric, no_new_edge_joins_two_vertices_of_a_loop)
{
    const Sheared mesh = sheared_grid(8);
    const Surface surface = analyze_surface(mesh.triangles, static_cast<Index>(mesh.vertices.rows()));
    const std::vector<char> rim = boundary_mask(surface);
    const auto rim_edges = [&](const Triangles& triangles) {
        int count = 0;
        for (Eigen::Index f = 0; f < triangles.rows(); ++f)
            for (int k = 0; k < 3; ++k) count += rim[triangles(f, k)] && rim[triangles(f, (k + 1) % 3)];
        return count;
    };
    EXPECT_LE(rim_edges(intrinsic_metric(mesh.vertices, surface).triangles), rim_edges(surface.triangles));
}

TEST(IntrinsicMetric, mollification_gives_every_triangle_an_area)
{
    Vertices vertices(4, 3);
    vertices << 0, 0, 0, 1, 0, 0, 2, 0, 0, 1, 1, 0;
    Triangles triangles(3, 3);
    triangles << 0, 1, 3, 1, 2, 3, 0, 2, 1;
    const Surface surface = analyze_surface(triangles, 4);
    const IntrinsicMetric metric = intrinsic_metric(vertices, surface, {.delaunay = false});
    EXPECT_GT(metric.mollification, 0.0);
    EXPECT_LT(metric.mollification, 1e-5);
    for (Eigen::Index f = 0; f < 3; ++f)
        EXPECT_GT(triangle_area(metric.lengths(f, 0), metric.lengths(f, 1), metric.lengths(f, 2)), 0.0);
}
