#include "embedding/widened_rim.h"
#include "random_disks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace koebe;
using namespace koebe::test;

namespace {

/// Vertices 0 to 5 of a hexagon, fanned from 0, and a stack of faces behind the edge 0-2.
struct Lopsided {
    explicit Lopsided(int count)
    {
        FaceList faces{{0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
        std::mt19937 random(1);
        for (auto face : stacked_disk(count, 0, random)) {
            for (Index& v : face) v = v < 3 ? v : v + 3;
            faces.push_back(face);
        }
        filled = {as_triangles(faces), count + 6, count + 6};
    }
    FilledDisk filled;
    VertexLoop outer{0, 1, 2, 3, 4, 5};
};

VectorXcd hexagon()
{
    VectorXcd rim(6);
    for (int i = 0; i < 6; ++i) rim[i] = std::polar(1.0, std::numbers::pi / 3.0 * i);
    return rim;
}

}  // namespace

TEST(WidenedRim, the_arc_before_many_faces_is_long)
{
    const Lopsided small(0), large(1000);
    EXPECT_LT((widened_rim(small.filled, small.outer, hexagon(), 0.0) - hexagon()).norm(), 1e-14);
    const VectorXcd rim = widened_rim(large.filled, large.outer, hexagon(), 1.0);
    EXPECT_GT(std::arg(rim[2] / rim[0]), 2.0);
    EXPECT_NEAR((rim.array().abs() - 1.0).abs().maxCoeff(), 0.0, 1e-14);
    for (int i = 0; i < 6; ++i) EXPECT_GT(std::arg(rim[(i + 1) % 6] / rim[i]), 0.0);
}

TEST(WidenedRim, no_step_is_left_without_its_share)
{
    VectorXcd rim(6);
    for (int i = 0; i < 6; ++i) rim[i] = std::polar(1.0, 1e-3 * i);
    const Lopsided disk(0);
    const VectorXcd wide = widened_rim(disk.filled, disk.outer, rim, 0.3);
    for (int i = 0; i < 5; ++i) EXPECT_GT(std::arg(wide[i + 1] / wide[i]), 0.2);
    EXPECT_EQ(wide[0], rim[0]);
}
