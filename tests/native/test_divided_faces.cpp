// Laws of faces with vertices of neighbours on their edges: pieces cover them, and cracks separate nothing.
#include "flat/divided_faces.h"

#include "flat/noise_level.h"
#include "part_maps/part_mesh.h"
#include "parts/parts.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

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

TEST(DividedFaces, CracksOfACurvedSheetAreNoHoles)
{
    // A dome of squares in two triangles. A vertex lies on every third diagonal, and only one triangle has it.
    constexpr int n = 10;
    std::vector<Eigen::RowVector3d> points;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) {
            const double x = 2.0 * i / n - 1.0, y = 2.0 * j / n - 1.0;
            points.emplace_back(x, y, -0.4 * (x * x + y * y));
        }
    std::vector<std::array<Index, 3>> faces;
    std::vector<std::array<Index, 3>> cracks;  // the first face at each, and its two corners there
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const Index a = (n + 1) * i + j, b = a + n + 1, c = b + 1, d = a + 1;
            faces.push_back({a, b, c});
            if ((i + j) % 3 != 0) {
                faces.push_back({a, c, d});
                continue;
            }
            const Index middle = static_cast<Index>(points.size());
            points.push_back(0.3 * points[a] + 0.7 * points[c]);
            cracks.push_back({static_cast<Index>(faces.size()) - 1, 0, 2});
            faces.push_back({middle, d, a});
            faces.push_back({c, d, middle});
        }
    Vertices vertices(static_cast<Eigen::Index>(points.size()), 3);
    for (std::size_t v = 0; v < points.size(); ++v) vertices.row(static_cast<Eigen::Index>(v)) = points[v];
    Triangles triangles(static_cast<Eigen::Index>(faces.size()), 3);
    for (std::size_t f = 0; f < faces.size(); ++f)
        triangles.row(static_cast<Eigen::Index>(f)) << faces[f][0], faces[f][1], faces[f][2];
    ExecutionContext context;
    const PartsResult result = parts_of(vertices, triangles, {}, context);
    EXPECT_TRUE(result.converged);
    ASSERT_EQ(result.parts.size(), 1u);
    EXPECT_EQ(result.parts[0].faces.size(), faces.size());
    EXPECT_EQ(result.parts[0].loops.size(), 1u);
    for (const auto& [f, from, to] : cracks) {
        const Eigen::RowVector2d a = result.uv.row(3 * f + from), c = result.uv.row(3 * f + to),
                                 middle = result.uv.row(3 * (f + 1));
        EXPECT_LT((0.3 * a + 0.7 * c - middle).norm(), 1e-8);
    }
}

TEST(DividedFaces, PiecesOfAFaceLieInOnePlane)
{
    // Half of a face beside a plate lies in the plate's plane as regions measure it, the other half does not.
    const Vertices vertices{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, -1e-3, 8e-6}, {1, -1, 8e-3}};
    const Triangles triangles{{0, 1, 2}, {0, 2, 3}, {0, 4, 1}, {4, 5, 1}};
    CutSurface surface = cut_surface(vertices, triangles, {});
    EXPECT_EQ(planar_regions(surface).of, (std::vector<Index>{0, 0, 0, 1}));
    surface.face = {0, 1, 2, 2};
    const std::vector<Index> of = planar_regions(surface).of;
    EXPECT_EQ(of[2], of[3]);
    EXPECT_NE(of[2], of[0]);
}

}  // namespace
}  // namespace koebe
