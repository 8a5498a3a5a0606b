#include "circle_domain.h"
#include "core/errors.h"
#include "holes/fan_filling.h"
#include "mesh/topology.h"
#include "surface/laplacian.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace koebe;
using namespace koebe::test;

TEST(HoleFilling, a_fan_has_its_centre_at_the_mean_of_the_vertices)
{
    // A point more on one side of the square moves it.
    Vertices loop(5, 3);
    loop << 0, 0, 1, 0, 2, 1, 2, 2, 1, 2, 0, 1, 1, 0, 1;
    const SurfacePatch patch = fill_on_surface(loop);
    EXPECT_EQ(patch.vertices.topRows(5), loop);
    EXPECT_LT((patch.vertices.row(5) - Eigen::RowVector3d(1, 0.8, 1)).norm(), 1e-15);
    EXPECT_EQ(patch.triangles.rows(), 5);
    // The loop runs clockwise seen from above, with the surface on its left; so the patch is seen from above.
    for (Eigen::Index f = 0; f < 5; ++f) {
        const Eigen::RowVector3d a = patch.vertices.row(patch.triangles(f, 0));
        const Eigen::RowVector3d u = patch.vertices.row(patch.triangles(f, 1)) - a;
        const Eigen::RowVector3d v = patch.vertices.row(patch.triangles(f, 2)) - a;
        EXPECT_GT(u.cross(v)[2], 0.0);
    }
}

TEST(HoleFilling, the_filled_surface_is_a_sphere_of_one_orientation)
{
    const LiftedDomain sample(1200, Lift::sphere);
    const Surface before = analyze_surface(sample.domain.triangles, static_cast<Index>(sample.vertices.rows()));
    const FilledSurface filled = fill_holes(sample.vertices, sample.domain.triangles);
    const Surface after = analyze_surface(filled.triangles, static_cast<Index>(filled.vertices.rows()));
    EXPECT_EQ(after.euler_characteristic, 2);
    EXPECT_TRUE(after.loops.empty());
    EXPECT_TRUE(after.reoriented.empty());
    EXPECT_EQ(filled.vertices.topRows(sample.vertices.rows()), sample.vertices);
    EXPECT_EQ(filled.triangles.topRows(sample.domain.triangles.rows()), sample.domain.triangles);
    EXPECT_EQ(filled.vertices.rows(), sample.vertices.rows() + 5);

    // Label k is on as many faces as loop k has edges, and on no vertex of another loop.
    ASSERT_EQ(static_cast<Eigen::Index>(filled.label.size()), filled.triangles.rows());
    EXPECT_EQ(std::count(filled.label.begin(), filled.label.end(), -1), sample.domain.triangles.rows());
    for (std::size_t k = 0; k < before.loops.size(); ++k) {
        const VertexLoop& loop = before.loops[k];
        EXPECT_EQ(std::count(filled.label.begin(), filled.label.end(), static_cast<Index>(k)),
                  static_cast<std::ptrdiff_t>(loop.size()));
        for (std::size_t f = 0; f < filled.label.size(); ++f)
            for (int c = 0; c < 3 && filled.label[f] == static_cast<Index>(k); ++c) {
                const Index v = filled.triangles(f, c);
                EXPECT_TRUE(v >= sample.vertices.rows() || std::find(loop.begin(), loop.end(), v) != loop.end());
            }
    }
}

TEST(HoleFilling, only_the_loops_asked_for_are_filled)
{
    const LiftedDomain sample(1200, Lift::sphere);
    const FilledSurface filled = fill_holes(sample.vertices, sample.domain.triangles, std::vector<Index>{3, 1, 3});
    const Surface before = analyze_surface(sample.domain.triangles, static_cast<Index>(sample.vertices.rows()));
    const Surface after = analyze_surface(filled.triangles, static_cast<Index>(filled.vertices.rows()));
    EXPECT_EQ(after.loops, (std::vector<VertexLoop>{before.loops[0], before.loops[2], before.loops[4]}));
    EXPECT_EQ(fill_holes(sample.vertices, sample.domain.triangles, std::vector<Index>{}).triangles,
              sample.domain.triangles);
    EXPECT_THROW(fill_holes(sample.vertices, sample.domain.triangles, std::vector<Index>{5}), InputError);
    EXPECT_THROW(fill_holes(sample.vertices, sample.domain.triangles, std::vector<Index>{-1}), InputError);
}

TEST(HoleFilling, faces_against_the_others_stay_and_are_named)
{
    LiftedDomain sample(1200, Lift::sphere);
    sample.domain.triangles.row(7).reverseInPlace();
    const FilledSurface filled = fill_holes(sample.vertices, sample.domain.triangles);
    EXPECT_EQ(filled.triangles.topRows(sample.domain.triangles.rows()), sample.domain.triangles);
    const std::vector<Index> turned{7};
    EXPECT_EQ(analyze_surface(filled.triangles, static_cast<Index>(filled.vertices.rows())).reoriented, turned);
    ASSERT_EQ(filled.warnings.size(), 1U);
    EXPECT_EQ(filled.warnings[0].elements, turned);
}

TEST(HoleFilling, a_planar_hole_is_filled_by_its_own_area)
{
    const CircleDomain domain = make_circle_domain({{{0.0, 0.0}, 1.0}, {{0.3, 0.2}, 0.3}}, 500);
    const Vertices plane = lift(domain.points, Lift::plane);
    const FilledSurface filled = fill_holes(plane, domain.triangles, std::vector<Index>{1});
    const double area = vertex_areas(filled.triangles, edge_lengths(filled.vertices, filled.triangles),
                                     static_cast<Index>(filled.vertices.rows()))
                            .sum();
    const double n = static_cast<double>(domain.loops[0].size());
    EXPECT_NEAR(area, 0.5 * n * std::sin(2.0 * std::numbers::pi / n), 1e-12);
}

TEST(HoleFilling, a_planar_patch_matches_the_edge_length_of_its_polygon)
{
    for (const int m : {12, 60, 240}) {
        const VectorXcd polygon = test::points_on({0.0, 2.0}, m);
        const double h = std::abs(polygon[1] - polygon[0]);
        const PlanarMesh patch = planar_patch(polygon);
        EXPECT_EQ(patch.points.head(m), polygon);
        double longest = 0.0, mean = 0.0;
        for (Eigen::Index f = 0; f < patch.triangles.rows(); ++f)
            for (int k = 0; k < 3; ++k) {
                const double length =
                    std::abs(patch.points[patch.triangles(f, (k + 1) % 3)] - patch.points[patch.triangles(f, k)]);
                longest = std::max(longest, length);
                mean += length / (3.0 * patch.triangles.rows());
            }
        EXPECT_LT(longest, 1.8 * h) << m;
        EXPECT_NEAR(mean, h, 0.2 * h) << m;
    }
}
