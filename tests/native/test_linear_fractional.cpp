#include "core/errors.h"
#include "schottky/finer_faces.h"
#include "schottky/group_word.h"
#include "schottky/linear_fractional.h"

#include "circle_domain.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace koebe {
namespace {

const LinearFractional some_map = linear_fractional({2.0, 1.0}, {0.3, -1.0}, {1.5, 0.5}, {-0.7, 2.0});

TEST(LinearFractional, is_undone_by_its_inverse_and_of_determinant_1)
{
    const Complex z(0.4, -0.2);
    EXPECT_LT(std::abs(some_map.inverse()(some_map(z)) - z), 1e-14);
    EXPECT_LT(std::abs(some_map.a * some_map.d - some_map.b * some_map.c - 1.0), 1e-14);
    EXPECT_LT(std::abs((some_map * some_map)(z)-some_map(some_map(z))), 1e-13);
}

TEST(LinearFractional, takes_circles_to_circles)
{
    for (const Circle circle :
         {Circle{{0.3, 0.1}, 0.2}, Circle{{-3.0, 2.0}, 1.5}, Circle{-some_map.d / some_map.c, 0.4}}) {
        const Circle image = some_map(circle);
        for (const Complex z : test::points_on(circle, 7))
            EXPECT_NEAR(std::abs(some_map(z) - image.center), image.radius, 1e-12 * image.radius);
    }
}

TEST(LinearFractional, takes_the_outside_of_its_isometric_circle_to_the_inside_of_an_equal_one)
{
    const Circle first = some_map.isometric_circle(), second = some_map.inverse().isometric_circle();
    EXPECT_DOUBLE_EQ(first.radius, second.radius);
    for (const Complex z : test::points_on(first, 5))
        EXPECT_NEAR(std::abs(some_map(z) - second.center), second.radius, 1e-13);
    EXPECT_LT(std::abs(some_map(first.center + 3.0 * first.radius) - second.center), second.radius);
}

TEST(LinearFractional, has_the_multiplier_at_its_fixed_points)
{
    const auto [z, w] = some_map.attracting();
    const Complex fixed = z / w;
    EXPECT_LT(std::abs(some_map(fixed) - fixed), 1e-13);
    const Complex step(1e-6, 0.0);
    EXPECT_LT(std::abs((some_map(fixed + step) - some_map(fixed - step)) / (2.0 * step) - some_map.multiplier()), 1e-8);
    EXPECT_LT(std::abs(some_map.multiplier()), 1.0);
    const LinearFractional scaling = linear_fractional(0.1, 0.0, 0.0, 1.0);
    EXPECT_NEAR(scaling.multiplier().real(), 0.1, 1e-15);
    EXPECT_EQ(scaling.inverse().attracting()[1], 0.0);  // infinity
}

TEST(LinearFractional, is_exact_beside_a_small_isometric_circle)
{
    // z -> 1 + r^2 / (z + 1): a and d are as large as 1 / r.
    const double r = 1e-7;
    const Complex i(0.0, 1.0);
    const LinearFractional map{i / r, i / r * (1.0 + r * r), i / r, i / r};
    for (const Complex z : test::points_on({-1.0, r}, 6)) EXPECT_NEAR(std::abs(map(z) - 1.0) / r, 1.0, 1e-8);
}

TEST(LinearFractional, is_found_again_from_points)
{
    const VectorXcd from = test::points_on({{5.0, 1.0}, 0.3}, 9);
    const LinearFractional found = fitted_map(from, some_map(from));
    EXPECT_LT((found(from) - some_map(from)).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT(std::abs(found(Complex(5.0, 1.4)) - some_map(Complex(5.0, 1.4))), 1e-10);
    EXPECT_THROW(fitted_map(from, VectorXcd::Constant(9, 2.0)), SolverError);
    EXPECT_THROW(linear_fractional(1.0, 2.0, 2.0, 4.0), SolverError);
}

TEST(GroupWord, is_reduced)
{
    GroupWord word;
    for (const int letter : {1, 2, -2, 0, -1, 3}) append_letter(word, letter);
    EXPECT_EQ(word, GroupWord{3});
    EXPECT_EQ(product({1, -2}, {2, 3}), (GroupWord{1, 3}));
    EXPECT_EQ(product({1, -2}, inverse_of({1, -2})), GroupWord{});
}

TEST(GroupWord, applies_its_last_letter_first)
{
    const std::vector<LinearFractional> generators{linear_fractional(2.0, 0.0, 0.0, 1.0),
                                                   linear_fractional(1.0, 1.0, 0.0, 1.0)};
    EXPECT_LT(std::abs(applied({1, 2}, generators, Complex(3.0)) - 8.0), 1e-14);
    EXPECT_LT(std::abs(applied({-2, 1}, generators, Complex(3.0)) - 5.0), 1e-14);
    EXPECT_NEAR(applied({1, 2}, generators, Circle{1.0, 0.5}).radius, 1.0, 1e-14);
}

TEST(FinerFaces, keep_the_surface_and_its_corners)
{
    Vertices vertices(4, 3);
    vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1;
    Triangles triangles(2, 3);
    triangles << 0, 1, 2, 2, 1, 3;
    const FinerFaces finer = finer_faces(vertices, triangles, 30, 5);
    ASSERT_EQ(finer.triangles.rows(), 32);
    for (Index f = 0; f < 2; ++f)
        for (int k = 0; k < 3; ++k) {
            const Index corner = finer.corners[f][k];
            EXPECT_EQ(finer.triangles(corner / 3, corner % 3), triangles(f, k));
            EXPECT_EQ(finer.input_face[corner / 3], f);
        }
    double area = 0.0;
    for (Eigen::Index f = 0; f < 32; ++f) {
        const Eigen::RowVector3d a = finer.vertices.row(finer.triangles(f, 0));
        const Eigen::RowVector3d b = finer.vertices.row(finer.triangles(f, 1)),
                                 c = finer.vertices.row(finer.triangles(f, 2));
        area += 0.5 * (b - a).cross(c - a).norm();
    }
    EXPECT_NEAR(area, 0.5 + 0.5 * std::sqrt(3.0), 1e-14);
}

}  // namespace
}  // namespace koebe
