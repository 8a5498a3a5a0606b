#include "cut_samples.h"
#include "part_maps/part_mesh.h"
#include "surface/mirror.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

using namespace koebe;
using namespace koebe::test;

TEST(Mirror, of_a_flat_sheet_is_not_its_own_plane_and_a_strip_is_its_own_image_lengthwise)
{
    // Quadrilaterals in a row: each is its own image across the strip, but its corners change places.
    Vertices vertices(12, 3);
    Triangles triangles(10, 3);
    std::vector<Index> polygon;
    for (Index i = 0; i < 6; ++i) {
        const double x = i * (1.0 + 0.1 * i);
        vertices.row(2 * i) << x, 0.0, 0.0;
        vertices.row(2 * i + 1) << x, 1.0, 0.0;
    }
    for (Index i = 0; i < 5; ++i) {
        triangles.row(2 * i) << 2 * i, 2 * i + 2, 2 * i + 3;
        triangles.row(2 * i + 1) << 2 * i, 2 * i + 3, 2 * i + 1;
        polygon.insert(polygon.end(), 2, i);
    }
    const Mirror mirror = find_mirror(vertices, triangles, polygon);
    ASSERT_EQ(mirror.vertex.size(), 12U);
    for (Index v = 0; v < 12; ++v) EXPECT_EQ(mirror.vertex[v], v ^ 1);
    vertices(1, 1) = 1.01;  // of one corner: no longer
    EXPECT_TRUE(find_mirror(vertices, triangles, polygon).image.empty());
}

TEST(Mirror, of_a_surface_torn_on_one_side_has_polygons_but_no_vertices)
{
    Mesh mesh = figure();
    std::vector<Index> polygon;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) polygon.push_back(static_cast<Index>(f / 2));
    const Mirror whole = find_mirror(mesh.vertices, mesh.triangles, polygon);
    Index torn_at = 0;
    while (whole.vertex[torn_at] == torn_at) ++torn_at;
    const Index copy = static_cast<Index>(mesh.vertices.rows());
    mesh.vertices.conservativeResize(copy + 1, 3);
    mesh.vertices.row(copy) = Eigen::RowVector3d(mesh.vertices.row(torn_at));
    Eigen::Index face = 0;
    while ((mesh.triangles.row(face).array() != torn_at).all()) ++face;
    for (const Eigen::Index f : {face, face ^ 1})  // both triangles of one polygon have the copy
        for (int k = 0; k < 3; ++k)
            if (mesh.triangles(f, k) == torn_at) mesh.triangles(f, k) = copy;
    const Mirror torn = find_mirror(mesh.vertices, mesh.triangles, polygon);
    EXPECT_FALSE(torn.image.empty());
    EXPECT_TRUE(torn.vertex.empty());
}

TEST(Mirror, is_found_in_any_pose_and_not_where_there_is_none)
{
    Mesh mesh = figure();
    std::vector<Index> polygon;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) polygon.push_back(static_cast<Index>(f / 2));
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(1.1, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix();
    const Vertices unit = mesh.vertices / std::sqrt(face_areas(mesh.vertices, mesh.triangles).sum());
    for (const bool turned : {false, true}) {
        const Vertices posed = turned ? Vertices(unit * turn.transpose()) : unit;
        const Mirror mirror = find_mirror(posed, mesh.triangles, polygon);
        ASSERT_EQ(mirror.image.size(), static_cast<std::size_t>(mesh.triangles.rows() / 2));
        for (std::size_t g = 0; g < mirror.image.size(); ++g) {
            EXPECT_EQ(mirror.image[mirror.image[g]], static_cast<Index>(g));
            EXPECT_EQ(mirror.side[g], -mirror.side[mirror.image[g]]);
        }
        ASSERT_EQ(mirror.vertex.size(), static_cast<std::size_t>(posed.rows()));
        for (Index v = 0; v < static_cast<Index>(posed.rows()); ++v) EXPECT_EQ(mirror.vertex[mirror.vertex[v]], v);
    }
    Vertices bent = unit;
    bent.col(2).array() += 0.01 * (3.0 * unit.col(0).array() + unit.col(1).array()).sin();
    EXPECT_TRUE(find_mirror(bent, mesh.triangles, polygon).image.empty());
}

TEST(Mirror, of_two_polygons_that_are_equally_near_it_takes_the_first)
{
    // Two sheets of one triangle on each side. The image of the first is half way between the sheets of the other side.
    const double gap = 0x1p-16;
    const double height[] = {0.0, gap, -gap, gap};
    Vertices vertices(12, 3);
    Triangles triangles(4, 3);
    for (Index f = 0; f < 4; ++f) {
        const double side = f < 2 ? -1.0 : 1.0;
        vertices.row(3 * f) << side, 0.0, height[f];
        vertices.row(3 * f + 1) << 2.0 * side, 0.0, height[f];
        vertices.row(3 * f + 2) << side, 1.0, height[f];
        triangles.row(f) << 3 * f, 3 * f + 1, 3 * f + 2;
    }
    EXPECT_EQ(find_mirror(vertices, triangles, {}).image, (std::vector<Index>{2, 3, 0, 1}));
}
