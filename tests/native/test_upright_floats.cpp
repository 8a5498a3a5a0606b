#include "quality/upright_floats.h"

#include "quality/stored_uv.h"

#include <gtest/gtest.h>

#include <random>

namespace koebe {
namespace {

struct Plane {
    PlanarPoints points;
    Triangles triangles;
};

/// A grid of cells with random corners, turned. The middle row is so low that rounding turns faces over.
Plane with_low_row(int cells, double low, unsigned seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> jitter(-0.2, 0.2), angle(0.0, 6.28);
    const double turn = angle(random);
    Plane plane{PlanarPoints((cells + 1) * (cells + 1), 2), Triangles(2 * cells * cells, 3)};
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i) {
            const bool middle = j == cells / 2 || j == cells / 2 + 1;
            const double y = j <= cells / 2 ? j : j - 1.0 + low;
            const double x = i + jitter(random), at = y + (middle ? 0.0 : jitter(random));
            plane.points.row(j * (cells + 1) + i) << 7.3 * (x * std::cos(turn) - at * std::sin(turn)),
                7.3 * (x * std::sin(turn) + at * std::cos(turn));
        }
    for (int j = 0, f = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i, f += 2) {
            const int a = j * (cells + 1) + i, b = a + 1, c = a + cells + 2, d = a + cells + 1;
            plane.triangles.row(f) << a, b, c;
            plane.triangles.row(f + 1) << a, c, d;
        }
    return plane;
}

Index turned_over(const Plane& plane, const PlanarPoints& rounded)
{
    Index count = 0;
    for (const auto face : plane.triangles.rowwise()) {
        const auto corner = [&](int k) { return StoredPoint{rounded(face[k], 0), rounded(face[k], 1)}; };
        count += StoredFace(corner(0), corner(1), corner(2)).doubtful();
    }
    return count;
}

TEST(UprightFloats, rounding_turns_no_face_over)
{
    Index plainly = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
        const Plane plane = with_low_row(20, 1.5e-7, seed);
        plainly += turned_over(plane, plane.points.unaryExpr(&as_stored));
        const PlanarPoints rounded = upright_floats(plane.points, plane.triangles);
        EXPECT_EQ(turned_over(plane, rounded), 0) << seed;
        EXPECT_EQ((rounded - PlanarPoints(rounded.unaryExpr(&as_stored))).norm(), 0.0);
        EXPECT_LT((rounded - plane.points).cwiseAbs().maxCoeff(), 5.0 * 1.6e-5) << seed;
    }
    EXPECT_GT(plainly, 40);
}

TEST(UprightFloats, a_map_without_thin_faces_is_only_rounded)
{
    const Plane plane = with_low_row(12, 0.7, 3);
    EXPECT_EQ((upright_floats(plane.points, plane.triangles) - plane.points.unaryExpr(&as_stored)).norm(), 0.0);
}

}  // namespace
}  // namespace koebe
