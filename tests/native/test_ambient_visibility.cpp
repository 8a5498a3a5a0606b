#include "surface/ambient_visibility.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace koebe;

TEST(AmbientVisibility, AConvexSurfaceIsSeenFromEverywhere)
{
    Vertices corners(4, 3);
    corners << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    Triangles faces(4, 3);
    faces << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2;
    EXPECT_EQ(ambient_visibility(corners, faces).minCoeff(), 1.0);
    faces.col(1).swap(faces.col(2));  // inside out: the outer side stays
    EXPECT_EQ(ambient_visibility(corners, faces).minCoeff(), 1.0);
}

TEST(AmbientVisibility, TheBottomOfALongGrooveSeesItsWedge)
{
    for (const double half_angle : {0.25, 0.6, 1.2}) {  // between a side and the bisector
        constexpr int rows = 5, columns = 5;            // a ridge with a groove along its top
        const double x = std::sin(half_angle), z = std::cos(half_angle);
        Vertices vertices(rows * columns, 3);
        Triangles faces(2 * (rows - 1) * (columns - 1), 3);
        Eigen::Index f = 0;
        for (Index i = 0; i < rows; ++i) {
            const double y = 10.0 * (i - 2);
            vertices.middleRows<columns>(columns * i) << -6, y, -9, -x, y, z, 0, y, 0, x, y, z, 6, y, -9;
            for (Index k = 0; k + 1 < columns && i + 1 < rows; ++k) {
                const Index a = columns * i + k, b = a + 1, c = b + columns, d = a + columns;
                faces.row(f++) << a, b, c;
                faces.row(f++) << a, c, d;
            }
        }
        const VectorXd seen = ambient_visibility(vertices, faces);
        EXPECT_NEAR(seen[columns * (rows / 2) + 2], x, 0.1) << half_angle;
    }
}

}  // namespace
