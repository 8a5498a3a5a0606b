#include "core/errors.h"
#include "even/even_dial.h"
#include "even/pinned_map.h"
#include "grids.h"
#include "mesh/topology.h"
#include "parts/sewing.h"
#include "planar/boundary_crossings.h"
#include "planar/planar_predicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace koebe;

namespace {

/// A square grid of the plane, which is its own map.
struct PinnedGrid {
    int size = 10;
    Vertices vertices{(size + 1) * (size + 1), 3};
    Triangles triangles = test::grid(size, size, [this](int i, int j) { return at(i, j); });
    PlanarPoints points{(size + 1) * (size + 1), 2};

    PinnedGrid()
    {
        for (int i = 0; i <= size; ++i)
            for (int j = 0; j <= size; ++j) {
                points.row(at(i, j)) << i / double(size), j / double(size);
                vertices.row(at(i, j)) << points.row(at(i, j)), 0.0;
            }
    }

    Index at(int i, int j) const { return static_cast<Index>(i * (size + 1) + j); }

    void expect_one_to_one(const PlanarPoints& map) const
    {
        for (Eigen::Index f = 0; f < triangles.rows(); ++f) EXPECT_GT(signed_area(map, triangles, f), 0.0);
        const Surface surface = analyze_surface(triangles, static_cast<Index>(vertices.rows()));
        EXPECT_TRUE(crossing_boundary_edges(surface.loops, map, 0.0).empty());
    }
};

}  // namespace

TEST(PinnedMap, two_pins_are_met_by_a_similarity)
{
    const PinnedGrid grid;
    Pins pins{{grid.at(0, 0), grid.at(10, 10)}, PlanarPoints(2, 2)};
    pins.places << 3.0, 1.0, 2.0, 2.0;
    const PinPlacement placement = placement_at_pins(pins, grid.points);
    EXPECT_NEAR(std::abs(placement(Complex(0.0, 0.0)) - Complex(3.0, 1.0)), 0.0, 1e-15);
    EXPECT_NEAR(std::abs(placement(Complex(1.0, 1.0)) - Complex(2.0, 2.0)), 0.0, 1e-15);
}

TEST(PinnedMap, pins_that_bend_are_met_exactly_and_the_map_stays_one_to_one)
{
    const PinnedGrid grid;
    ExecutionContext context;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> shift(-0.25, 0.25);
    for (int round = 0; round < 10; ++round) {
        EvenDial dial(grid.vertices, grid.triangles, grid.points, false);
        Pins pins{{grid.at(0, 0), grid.at(10, 0), grid.at(10, 10), grid.at(0, 10), grid.at(5, 5)}, PlanarPoints(5, 2)};
        for (Eigen::Index i = 0; i < 5; ++i)
            pins.places.row(i) = grid.points.row(pins.vertices[i]) + Eigen::RowVector2d(shift(random), shift(random));
        dial.pin(pins, 0.5, context);
        const PlanarPoints map = dial.points();
        for (Eigen::Index i = 0; i < 5; ++i) EXPECT_EQ(map.row(pins.vertices[i]), pins.places.row(i));
        grid.expect_one_to_one(map);
    }
}

TEST(PinnedMap, pins_in_the_way_are_named_and_the_map_stays)
{
    const PinnedGrid grid;
    ExecutionContext context;
    EvenDial dial(grid.vertices, grid.triangles, grid.points, false);
    const PlanarPoints before = dial.points();
    // Two edges whose ends are pinned so that they cross.
    Pins pins{{grid.at(2, 2), grid.at(3, 2), grid.at(7, 7), grid.at(8, 7)}, PlanarPoints(4, 2)};
    pins.places << 0.0, 0.0, 1.0, 1.0, 1.0, 0.0, 0.0, 1.0;
    try {
        dial.pin(pins, 0.5, context);
        FAIL();
    } catch (const SolverError& error) {
        EXPECT_FALSE(error.elements().empty());
        for (const Index v : error.elements()) EXPECT_NE(std::ranges::find(pins.vertices, v), pins.vertices.end());
    }
    EXPECT_EQ(dial.points(), before);
}

TEST(Sewing, two_islands_become_one_where_the_larger_lay)
{
    const PinnedGrid grid;
    ExecutionContext context;
    SewingOptions options;
    options.uv.resize(3 * grid.triangles.rows(), 2);
    for (Eigen::Index f = 0; f < grid.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            options.uv.row(3 * f + k) = grid.points.row(grid.triangles(f, k));
            if (f / 2 % grid.size < 3) options.uv(3 * f + k, 0) -= 5.0;  // three columns lie elsewhere
        }
    for (int j = 0; j < grid.size; ++j) options.edges.push_back({grid.at(3, j), grid.at(3, j + 1)});
    const SewnLayer sewn = sew_islands(grid.vertices, grid.triangles, options, context);
    EXPECT_EQ(sewn.joined, 2);
    EXPECT_EQ(sewn.sewn, grid.size);
    for (Eigen::Index f = 0; f < grid.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            EXPECT_LT((sewn.uv.row(3 * f + k) - grid.points.row(grid.triangles(f, k))).norm(), 1e-6);
}
