#include "splitting/mirrored_coarse.h"
#include "surface/mirror.h"
#include "surface/mirror_plane.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace {

using namespace koebe;

/// A closed body, with rings of faces round an axis that has nothing to do with its shape, turned in space.
struct Body {
    Vertices vertices;
    Triangles triangles;
    Eigen::RowVector3d x;  // where the x axis of the shape is
};

/// @param skew 0: the body is its own mirror image in the shape's plane x = 0
Body body(double skew)
{
    constexpr Index rings = 29, around = 40;
    const Eigen::Matrix3d of_rings = Eigen::Quaterniond(0.3, 0.8, -0.4, 0.33).normalized().toRotationMatrix();
    const Eigen::Matrix3d in_space = Eigen::Quaterniond(0.7, -0.2, 0.5, 0.4).normalized().toRotationMatrix();
    const auto place = [&](double polar, double turn) {
        const Eigen::Vector3d d = of_rings * Eigen::Vector3d(std::sin(polar) * std::cos(turn),
                                                             std::sin(polar) * std::sin(turn), std::cos(polar));
        const double r = 1.0 + 0.35 * d.y() + 0.3 * d.y() * d.z() + 0.3 * d.x() * d.x() +
                         skew * d.x() * (d.y() + d.y() * d.z() + 0.7 * d.z());
        return Eigen::RowVector3d((in_space * (r * d).cwiseProduct(Eigen::Vector3d(1.0, 1.6, 1.2))).transpose());
    };
    Body own{Vertices(rings * around + 2, 3), Triangles(2 * rings * around, 3), in_space.col(0).transpose()};
    for (Index i = 0; i < rings; ++i)
        for (Index k = 0; k < around; ++k)
            own.vertices.row(around * i + k) =
                place(std::numbers::pi * (i + 1) / (rings + 1), 2.0 * std::numbers::pi * k / around);
    own.vertices.row(rings * around) = place(0.0, 0.0);
    own.vertices.row(rings * around + 1) = place(std::numbers::pi, 0.0);
    Eigen::Index f = 0;
    for (Index k = 0; k < around; ++k) {
        const Index next = (k + 1) % around, last = around * (rings - 1);
        own.triangles.row(f++) << rings * around, k, next;
        own.triangles.row(f++) << rings * around + 1, last + next, last + k;
        for (Index i = 0; i + 1 < rings; ++i) {
            const Index a = around * i + k, b = around * i + next, c = b + around, d = a + around;
            own.triangles.row(f++) << a, d, c;
            own.triangles.row(f++) << a, c, b;
        }
    }
    return own;
}

TEST(MirrorPlane, IsFoundWhateverTheTriangulation)
{
    const Body own = body(0.0);
    ASSERT_TRUE(find_mirror(own.vertices, own.triangles, {}).image.empty()) << "the triangulation has no mirror";
    const auto plane = nearly_mirror(own.vertices, own.triangles);
    ASSERT_TRUE(plane);
    EXPECT_NEAR(std::abs(plane->normal.dot(own.x)), 1.0, 1e-4);
    EXPECT_NEAR(plane->distance(Eigen::RowVector3d::Zero()), 0.0, 1e-2);
}

TEST(MirrorPlane, ASkewBodyHasNone)
{
    const Body own = body(0.9);
    EXPECT_FALSE(nearly_mirror(own.vertices, own.triangles));
}

TEST(MirroredCoarseSurface, IsItsOwnMirrorImageOnVerticesOfTheFineOne)
{
    const Body own = body(0.0);
    const CutSurface whole =
        cut_surface(own.vertices, analyze_surface(own.triangles, static_cast<Index>(own.vertices.rows())), {});
    const auto plane = nearly_mirror(own.vertices, own.triangles);
    ASSERT_TRUE(plane);
    ExecutionContext context;
    const auto coarse = mirrored_coarse_surface(whole, *plane, {}, 900, context);
    ASSERT_TRUE(coarse);
    EXPECT_LE(coarse->triangles.rows(), 900);
    EXPECT_GT(coarse->triangles.rows(), 450);
    EXPECT_FALSE(find_mirror(coarse->vertices, coarse->triangles, {}).vertex.empty());
    EXPECT_EQ(std::set<Index>(coarse->vertex.begin(), coarse->vertex.end()).size(), coarse->vertex.size());
    EXPECT_EQ(analyze_surface(coarse->triangles, static_cast<Index>(coarse->vertex.size())).genus, 0);
    EXPECT_GE(*std::ranges::min_element(coarse->vertex_at), 0);
    for (std::size_t v = 0; v < coarse->vertex.size(); ++v) {
        EXPECT_EQ(coarse->vertex_at[coarse->vertex[v]], static_cast<Index>(v));
        const Eigen::RowVector3d off =
            coarse->vertices.row(static_cast<Index>(v)) - own.vertices.row(coarse->vertex[v]);
        EXPECT_LT(off.norm(), 0.4) << "an edge has a length of about 0.15";
    }
}

}  // namespace
