// Laws of the triangulation: every polygon's area and border are kept, whatever its shape.
#include "io/polygon_triangulation.h"

#include "core/errors.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>

namespace koebe {
namespace {

using Polygon = std::vector<Index>;

PolygonMesh mesh_of(const Vertices& vertices, const std::vector<Polygon>& polygons)
{
    PolygonMesh mesh;
    mesh.vertices = vertices;
    for (const Polygon& polygon : polygons) {
        mesh.corners.insert(mesh.corners.end(), polygon.begin(), polygon.end());
        mesh.face_begin.push_back(static_cast<Index>(mesh.corners.size()));
    }
    return mesh;
}

Vertices flat(const std::vector<std::array<double, 2>>& points)
{
    Vertices vertices(static_cast<Eigen::Index>(points.size()), 3);
    for (std::size_t i = 0; i < points.size(); ++i) vertices.row(i) << points[i][0], points[i][1], 0.0;
    return vertices;
}

Polygon counted(Index n)
{
    Polygon polygon;
    for (Index i = 0; i < n; ++i) polygon.push_back(i);
    return polygon;
}

Eigen::Vector3d normal_of(const Vertices& v, const Triangles& t, Eigen::Index f)
{
    const Eigen::Vector3d a = v.row(t(f, 0)), b = v.row(t(f, 1)), c = v.row(t(f, 2));
    return 0.5 * (b - a).cross(c - a);
}

/// Directed edges that no triangle has the other way round, with how often.
std::map<std::array<Index, 2>, int> border(const Triangles& triangles)
{
    std::map<std::array<Index, 2>, int> count;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int i = 0; i < 3; ++i) {
            const Index a = triangles(f, i), b = triangles(f, (i + 1) % 3);
            if (--count[{b, a}] == 0) count.erase({b, a});
            if (++count[{a, b}] == 0) count.erase({a, b});
        }
    std::erase_if(count, [](const auto& entry) { return entry.second < 0; });
    return count;
}

void expect_cut(const Vertices& vertices, const Polygon& polygon, double area)
{
    const Triangulation cut = triangulate(mesh_of(vertices, {polygon}));
    ASSERT_EQ(cut.triangles.rows() + 2, static_cast<Eigen::Index>(polygon.size()));
    double total = 0.0;
    for (Eigen::Index f = 0; f < cut.triangles.rows(); ++f) {
        EXPECT_GT(normal_of(vertices, cut.triangles, f).z(), 0.0);
        total += normal_of(vertices, cut.triangles, f).z();
        EXPECT_EQ(cut.face[f], 0);
    }
    EXPECT_NEAR(total, area, 1e-12 * area);
    std::map<std::array<Index, 2>, int> expected;
    for (std::size_t i = 0; i < polygon.size(); ++i) ++expected[{polygon[i], polygon[(i + 1) % polygon.size()]}];
    for (auto edge = expected.begin(); edge != expected.end();)  // a slit is passed both ways
        edge = expected.contains({edge->first[1], edge->first[0]}) && edge->first[0] < edge->first[1]
                   ? (expected.erase({edge->first[1], edge->first[0]}), expected.erase(edge))
                   : std::next(edge);
    EXPECT_EQ(border(cut.triangles), expected);
}

TEST(PolygonTriangulation, TrianglesPassAsTheyAre)
{
    const Triangulation cut = triangulate(mesh_of(flat({{0, 0}, {1, 0}, {0, 1}, {1, 1}}), {{2, 0, 1}, {1, 3, 2}}));
    ASSERT_EQ(cut.triangles.rows(), 2);
    EXPECT_TRUE(cut.triangles.row(0) == Eigen::RowVector3i(2, 0, 1));
    EXPECT_TRUE(cut.triangles.row(1) == Eigen::RowVector3i(1, 3, 2));
    EXPECT_EQ(cut.face, (std::vector<Index>{0, 1}));
    EXPECT_TRUE(cut.collapsed.empty());
}

TEST(PolygonTriangulation, QuadrilateralsKeepTheirAreaConvexOrNot)
{
    // Not convex at corner 2, and the diagonal that must not be taken is the shorter one.
    const std::vector<std::array<double, 2>> dart{{0, 0}, {10, -1}, {9, 0}, {10, 1}};
    const std::vector<std::array<double, 2>> kite{{0, 0}, {1, 0}, {1.2, 1.3}, {0, 1}};
    for (const double scale : {1e-100, 1e-12, 1.0, 1e150})
        for (std::size_t turn = 0; turn < 4; ++turn) {
            SCOPED_TRACE(std::to_string(scale) + " " + std::to_string(turn));
            auto rotated = [&](std::vector<std::array<double, 2>> points) {
                std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(turn), points.end());
                return Vertices(scale * flat(points));
            };
            expect_cut(rotated(dart), counted(4), scale * scale * 9.0);
            expect_cut(rotated(kite), counted(4), scale * scale * 1.25);
        }
}

TEST(PolygonTriangulation, AConvexQuadrilateralIsCutAlongItsShorterDiagonal)
{
    const Vertices long_02 = flat({{0, 0}, {1, 0}, {2, 1}, {1, 1}});
    const Triangulation cut = triangulate(mesh_of(long_02, {{0, 1, 2, 3}}));
    EXPECT_TRUE(cut.triangles.row(0) == Eigen::RowVector3i(0, 1, 3));
    EXPECT_TRUE(cut.triangles.row(1) == Eigen::RowVector3i(1, 2, 3));
}

TEST(PolygonTriangulation, PolygonsKeepTheirAreaConvexOrNot)
{
    for (const Index n : {5, 6, 16, 17, 40, 301}) {
        SCOPED_TRACE(n);
        Vertices round(n, 3), star(n, 3);
        double star_area = 0.0;
        for (Index i = 0; i < n; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / n;
            round.row(i) << std::cos(angle), std::sin(angle), 0.0;
            star.row(i) = (i % 2 && i + 1 < n ? 0.4 : 1.0) * round.row(i);
        }
        for (Index i = 0; i < n; ++i) {
            const auto a = star.row(i), b = star.row((i + 1) % n);
            star_area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
        }
        expect_cut(round, counted(n), 0.5 * n * std::sin(2.0 * std::numbers::pi / n));
        expect_cut(star, counted(n), star_area);
    }
}

TEST(PolygonTriangulation, NoTriangleOfAFlatPolygonIsTurnedOver)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> number(0.3, 1.0);
    for (Index n = 17; n < 97; ++n) {
        SCOPED_TRACE(n);
        Vertices star(n, 3);
        double area = 0.0;
        for (Index i = 0; i < n; ++i)
            star.row(i) = number(random) * Eigen::RowVector3d(std::cos(2.0 * std::numbers::pi * i / n),
                                                              std::sin(2.0 * std::numbers::pi * i / n), 0.0);
        for (Index i = 0; i < n; ++i)
            area += 0.5 * (star(i, 0) * star((i + 1) % n, 1) - star(i, 1) * star((i + 1) % n, 0));
        expect_cut(star, counted(n), area);
    }
}

TEST(PolygonTriangulation, CornersOnAStraightSideMakeNoTriangle)
{
    // A long triangle with more corners on its short side.
    for (Index n = 4; n < 12; ++n)
        for (int turn = 0; turn < 20; ++turn) {
            SCOPED_TRACE(std::to_string(n) + " " + std::to_string(turn));
            const Complex along = std::polar(1.0, 0.3 * turn);
            std::vector<std::array<double, 2>> points;
            for (Index i = 0; i + 1 < n; ++i) points.push_back({along.real() * i, along.imag() * i});
            points.push_back({-20.0 * along.imag(), 20.0 * along.real()});
            const Vertices vertices = flat(points);
            const Triangles cut = triangulate(mesh_of(vertices, {counted(n)})).triangles;
            ASSERT_EQ(cut.rows(), n - 2);
            for (Eigen::Index f = 0; f < cut.rows(); ++f) EXPECT_GT(normal_of(vertices, cut, f).z(), 9.9);
        }
}

TEST(PolygonTriangulation, APolygonMayGoRoundAHoleThroughASlit)
{
    const Vertices vertices = flat({{0, 0}, {3, 0}, {3, 3}, {0, 3}, {1, 1}, {1, 2}, {2, 2}, {2, 1}});
    expect_cut(vertices, {0, 1, 2, 3, 0, 4, 5, 6, 7, 4}, 8.0);
}

TEST(PolygonTriangulation, BentPolygonsAreCutToo)
{
    Vertices vertices(60, 3);
    for (Index i = 0; i < 60; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / 60;
        vertices.row(i) << std::cos(angle), std::sin(angle), 0.4 * std::cos(3.0 * angle);
    }
    const Triangulation cut = triangulate(mesh_of(vertices, {counted(60)}));
    EXPECT_EQ(cut.triangles.rows(), 58);
    EXPECT_EQ(border(cut.triangles).size(), 60u);
}

TEST(PolygonTriangulation, RepeatedCornersCountOnceAndCollapsedFacesAreListed)
{
    const Vertices vertices = flat({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    const Triangulation cut =
        triangulate(mesh_of(vertices, {{0, 1, 1, 2}, {0, 0, 2, 3, 3, 0}, {0, 1, 0}, {1, 1, 1}, {2}, {}, {0, 1, 2}}));
    ASSERT_EQ(cut.triangles.rows(), 3);
    EXPECT_TRUE(cut.triangles.row(0) == Eigen::RowVector3i(0, 1, 2));
    EXPECT_TRUE(cut.triangles.row(1) == Eigen::RowVector3i(0, 2, 3));
    EXPECT_EQ(cut.face, (std::vector<Index>{0, 1, 6}));
    EXPECT_EQ(cut.collapsed, (std::vector<Index>{2, 3, 4, 5}));
}

TEST(PolygonTriangulation, ToAndFroIsRefusedWithItsFaces)
{
    const Vertices vertices = flat({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    Polygon wound;
    for (Index i = 0; i < 936; ++i) wound.push_back(i % 4);
    try {
        triangulate(mesh_of(vertices, {{0, 1, 2}, {0, 1, 0, 2}, wound}));
        FAIL() << "was cut";
    } catch (const InputError& error) {
        EXPECT_EQ(error.elements(), (std::vector<Index>{1, 2}));
    }
}

TEST(PolygonTriangulation, PolygonsOfNoAreaAreCutInSomeWayWithoutACrash)
{
    const Vertices line = flat({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}});
    const Vertices point = Vertices::Constant(6, 3, 7.0);
    for (const Vertices& vertices : {line, point})
        for (const Index n : {4, 5, 6}) {
            try {
                EXPECT_EQ(triangulate(mesh_of(vertices, {counted(n)})).triangles.rows(), n - 2);
            } catch (const InputError& error) {
                EXPECT_EQ(error.elements(), std::vector<Index>{0});
            }
        }
}

}  // namespace
}  // namespace koebe
