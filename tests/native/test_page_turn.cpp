#include "flatten/page_turn.h"

#include "planar/planar_predicates.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

using namespace koebe;

namespace {

PlanarPoints turned(const PlanarPoints& points, Complex turn)
{
    PlanarPoints at(points.rows(), 2);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
        const Complex z = turn * Complex(points(i, 0), points(i, 1));
        at.row(i) << z.real(), z.imag();
    }
    return at;
}

}  // namespace

TEST(PageTurn, WhatFitsInOneTurnFitsInEveryTurn)
{
    std::mt19937 random(54);
    const auto number = [&] { return static_cast<double>(random() % 10001) / 10000.0; };
    for (int trial = 0; trial < 500; ++trial) {
        // points in a rectangle, some of them on its sides: no smaller one along the axes holds them
        const double width = 20.0 + 200.0 * number(), height = 20.0 + 200.0 * number();
        PlanarPoints points(4 + trial % 40, 2);
        for (Eigen::Index i = 0; i < points.rows(); ++i) points.row(i) << width * number(), height * number();
        points(0, 0) = points(1, 1) = 0.0;
        points(2, 0) = width;
        points(3, 1) = height;
        const PlanarPoints given = turned(points, std::polar(1.0, 2.0 * std::numbers::pi * number()));
        const std::optional<Complex> turn = turn_into(given, width, height);
        ASSERT_TRUE(turn);
        const Eigen::RowVector2d size = box_size(turned(given, *turn));
        EXPECT_LE(size[0], width * (1.0 + 1e-8));
        EXPECT_LE(size[1], height * (1.0 + 1e-8));
    }
}

TEST(PageTurn, AStripFitsAlongTheDiagonalOnly)
{
    PlanarPoints strip(4, 2);
    strip << 0.0, 0.0, 300.0, 0.0, 300.0, 20.0, 0.0, 20.0;
    ASSERT_TRUE(turn_into(strip, 183.0, 270.0));
    strip.col(0) *= 1.1;
    EXPECT_FALSE(turn_into(strip, 183.0, 270.0)) << "longer than the diagonal";
}
