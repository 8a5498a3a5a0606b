// Laws of faces with vertices of neighbours on their edges: pieces cover them, and cracks separate nothing.
#include "parts/divided_faces.h"

#include "part_maps/part_mesh.h"
#include "parts/parts.h"

#include <gtest/gtest.h>

#include <set>

namespace koebe {
namespace {

/// A square plate of two triangles, beside the three triangles of another one: a vertex of theirs lies on the edge.
struct Plates {
    Vertices vertices{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0.5}, {2, 1, 0.5}, {1, 0.4, 0}};
    Triangles triangles{{0, 1, 2}, {0, 2, 3}, {1, 4, 6}, {4, 5, 6}, {5, 2, 6}};
};

TEST(DividedFaces, AnEdgeIsDividedAtAVertexOfItsNeighbours)
{
    const Plates plates;
    const DividedFaces divided = divided_faces(plates.vertices, plates.triangles, {}, {});
    ASSERT_EQ(divided.triangles.rows(), 6);
    EXPECT_EQ(divided.face, (std::vector<Index>{0, 1, 2, 3, 4, 0}));
    EXPECT_EQ(divided.polygon, divided.face);
    ASSERT_EQ(divided.edges.size(), 1u);
    EXPECT_EQ(divided.edges[0].middle, 6);
    EXPECT_NEAR(std::abs(divided.edges[0].share - 0.5), 0.1, 1e-12);
    const VectorXd areas = face_areas(plates.vertices, divided.triangles);
    EXPECT_NEAR(areas[0] + areas[5], 0.5, 1e-12);
}

TEST(DividedFaces, SeamsAndVerticesBesideTheEdgeDivideNothing)
{
    Plates plates;
    EXPECT_TRUE(divided_faces(plates.vertices, plates.triangles, {}, {{2, 1}}).face.empty());
    plates.vertices(6, 0) = 1.001;
    EXPECT_TRUE(divided_faces(plates.vertices, plates.triangles, {}, {}).face.empty());
}

TEST(DividedFaces, PartsAreThoseOfTheSurfaceWithoutCracks)
{
    const Plates plates;
    ExecutionContext context;
    const PartsResult result = parts_of(plates.vertices, plates.triangles, {}, context);
    EXPECT_TRUE(result.converged);
    ASSERT_EQ(result.parts.size(), 1u);
    EXPECT_EQ(result.parts[0].faces, (std::vector<Index>{0, 1, 2, 3, 4}));
    EXPECT_GT(result.whole, 0.999);
    // Both sides of the crack lie on it.
    const auto at = [&](Index f, int k) -> Eigen::RowVector2d { return result.uv.row(3 * f + k); };
    EXPECT_LT((at(0, 1) - at(2, 0)).norm() + (at(0, 2) - at(4, 1)).norm(), 1e-6);
    EXPECT_LT((0.6 * at(0, 1) + 0.4 * at(0, 2) - at(2, 2)).norm(), 1e-6);
}

}  // namespace
}  // namespace koebe
