#include "core/errors.h"
#include "island_checks.h"
#include "packing/cell_mask.h"
#include "packing/packing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>

namespace koebe {
namespace {

constexpr double margin = 8.0 / 2048.0;

TEST(Packing, islands_lie_apart_in_the_square)
{
    std::mt19937_64 random(5);
    for (const int count : {1, 2, 3, 7, 7, 20, 300}) {
        std::vector<Outline> outlines;
        for (int i = 0; i < count; ++i) outlines.push_back(test::random_island(random));
        const IslandPacking packing = pack_islands(outlines, margin);
        EXPECT_EQ(packing.margin, margin);
        EXPECT_GE(test::least_gap(outlines, packing), margin) << count;
        for (const IslandPlace& place : packing.places) EXPECT_NEAR(std::abs(place.turn), 1.0, 1e-15);
    }
}

TEST(Packing, cells_that_two_masks_share_are_counted)
{
    std::mt19937_64 random(3);
    const auto upto = [&](int most) { return static_cast<int>(random() % static_cast<unsigned>(most + 1)); };
    const auto random_shape = [&] {
        CellShape shape{1 + upto(150), 1 + upto(80), {}, {}};
        for (int row = 0; row < shape.height; ++row)
            for (int from = upto(40); from < shape.width; from += 1 + upto(60)) {
                const int to = std::min(shape.width, from + 1 + upto(90));
                shape.runs.push_back({row, from, to});
                from = to;
            }
        return shape;
    };
    const auto cells = [](const CellShape& shape) {
        std::set<std::pair<int, int>> result;
        for (const CellRun& run : shape.runs)
            for (int column = run.from; column < run.to; ++column) result.emplace(column, run.row);
        return result;
    };
    for (int i = 0; i < 60; ++i) {
        const CellShape a = random_shape(), b = random_shape();
        const auto in_a = cells(a), in_b = cells(b);
        for (int k = 0; k < 4; ++k) {
            const int x = upto(a.width + b.width) - b.width, y = upto(a.height + b.height) - b.height;
            const auto both = std::ranges::count_if(in_b, [&](const auto& cell) {
                return in_a.contains({cell.first + x, cell.second + y});
            });
            std::int64_t work = 0;
            EXPECT_EQ(CellMask(a).shared(CellMask(b), x, y, work), both);
        }
    }
}

TEST(Packing, four_squares_fill_the_square_however_they_lay)
{
    std::vector<Outline> outlines;
    for (int i = 0; i < 4; ++i) outlines.push_back(test::rectangle(3.0, 3.0, 0.4 * i));
    const double most = 0.5 - margin;
    const double side = 3.0 * pack_islands(outlines, margin).scale;
    EXPECT_LE(side, most);
    EXPECT_GT(side, 0.998 * most);
}

TEST(Packing, an_island_stands_upright_unless_it_is_long)
{
    const std::vector<Outline> outlines = {test::rectangle(5.0, 4.0, 0.3)};
    const IslandPacking packing = pack_islands(outlines, margin);
    const PlanarPoints at = place_island(outlines[0].points, packing.places[0], packing.scale);
    const Eigen::RowVector2d size = at.colwise().maxCoeff() - at.colwise().minCoeff();
    EXPECT_NEAR(size[1], 1.0 - margin, 1e-3);
    EXPECT_NEAR(size[0], 0.8 * size[1], 1e-12);
    // The side of the smallest square round the long island is 6 / sqrt(2) instead of 5. A tube stays along the axes.
    for (const bool along_axes : {false, true}) {
        Outline island = test::rectangle(5.0, 1.0, along_axes ? 0.0 : 0.3);
        island.along_axes = along_axes;
        const IslandPacking long_one = pack_islands({island}, margin);
        EXPECT_GT(long_one.scale, 0.99 * (along_axes ? 1.0 / 5.0 : std::sqrt(2.0) / 6.0) * (1.0 - margin));
        EXPECT_EQ(std::abs(long_one.places[0].turn.real() * long_one.places[0].turn.imag()) < 1e-12, along_axes);
        EXPECT_GE(test::least_gap({island}, long_one), margin);
    }
}

TEST(Packing, few_islands_lie_close)
{
    // Two right triangles with legs of 1 make a square.
    Outline triangle;
    triangle.points.resize(3, 2);
    triangle.points << 0.0, 0.0, 1.0, 0.0, 0.0, 1.0;
    triangle.loops = {{0, 1, 2}};
    EXPECT_GT(pack_islands({triangle, triangle}, margin).scale, 0.97);
    std::mt19937_64 random(3);
    std::vector<Outline> islands;
    for (int i = 0; i < 9; ++i) islands.push_back(test::random_island(random));
    const IslandPacking packing = pack_islands(islands, margin), again = pack_islands(islands, margin);
    EXPECT_GE(test::least_gap(islands, packing), margin);
    for (std::size_t i = 0; i < islands.size(); ++i) {
        EXPECT_EQ(packing.places[i].turn, again.places[i].turn);
        EXPECT_EQ(packing.places[i].offset, again.places[i].offset);
    }
}

TEST(Packing, a_hole_takes_in_an_island)
{
    Outline frame = test::rectangle(1.0, 1.0, 0.0);
    const Outline hole = test::rectangle(0.8, 0.8, 0.0);
    frame.points.conservativeResize(8, 2);
    frame.points.bottomRows(4) = hole.points.array() + 0.1;
    frame.loops.push_back({7, 6, 5, 4});
    const std::vector<Outline> outlines = {test::rectangle(0.7, 0.7, 0.2), frame};
    const IslandPacking packing = pack_islands(outlines, margin);
    EXPECT_GT(packing.scale, 0.99);
    EXPECT_GE(test::least_gap(outlines, packing), margin);
}

TEST(Packing, slow_many_islands_have_room_and_less_margin)
{
    const std::vector<Outline> outlines(5000, test::rectangle(2.0, 1.0, 0.0));
    const IslandPacking packing = pack_islands(outlines, margin);
    EXPECT_LT(packing.margin, margin);
    EXPECT_GE(test::least_gap(outlines, packing), packing.margin);
    EXPECT_GT(2.0 * 5000.0 * packing.scale * packing.scale, 0.4);
}

TEST(Packing, small_islands_lie_apart_beside_large_islands)
{
    std::mt19937_64 random(8);
    std::vector<Outline> outlines;
    for (const double size : {40.0, 20.0, 20.0}) outlines.push_back(test::rectangle(size, 0.7 * size, 0.3));
    while (outlines.size() < 1100) outlines.push_back(test::random_island(random));
    const IslandPacking packing = pack_islands(outlines, margin);
    EXPECT_GE(test::least_gap(outlines, packing), packing.margin);
    outlines.erase(outlines.begin(), outlines.begin() + 3);
    EXPECT_GE(test::least_gap(outlines, pack_islands(outlines, margin)), packing.margin);
}

TEST(Packing, a_point_has_a_place_and_what_is_not_finite_has_none)
{
    std::vector<Outline> outlines = {test::rectangle(1.0, 1.0, 0.0), test::rectangle(0.0, 0.0, 0.0)};
    EXPECT_GE(test::least_gap(outlines, pack_islands(outlines, margin)), margin);
    EXPECT_TRUE(pack_islands({outlines[1]}, margin).places[0].offset.real() > 0.0);
    EXPECT_TRUE(pack_islands({}, margin).places.empty());
    outlines[0].points(0, 0) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(pack_islands(outlines, margin), SolverError);
}

}  // namespace
}  // namespace koebe
