#include "ear_domain.h"
#include "ears/least_arcs.h"

#include <gtest/gtest.h>

#include <numbers>

using namespace koebe;
using namespace koebe::test;

TEST(LeastArcs, the_edge_of_a_ear_takes_room_for_each_of_the_ears_edges)
{
    CircleDomain domain = make_circle_domain(five_circles(), 1000);
    const Index a = domain.loops[0][7], b = domain.loops[0][8];
    glue_ear(domain, 0, a, glue_ear(domain, 0, a, b, 0.8), 0.8);
    const Surface surface = require_bordered_genus_zero(domain.triangles, static_cast<Index>(domain.points.size()));
    const EarCut cut = cut_ears(lift(domain.points, Lift::plane), surface, domain.loops);
    const VectorXd room = least_arcs(cut.core, cut.loops[0], cut.ears, cut.vertices);
    const double mean = 2.0 * std::numbers::pi / static_cast<double>(room.size());
    for (Eigen::Index i = 0; i < room.size(); ++i) EXPECT_NEAR(room[i], i == 7 ? 3e-3 : 1e-3 * mean, 1e-15) << i;
}

TEST(LeastArcs, so_do_the_edges_of_a_part_with_a_loop_in_it)
{
    // A fan of 40 faces round 0, and behind its edge 1-2 a ring of six faces round a hole.
    constexpr Index n = 40;
    Surface surface;
    surface.triangles.resize(n + 6, 3);
    VertexLoop outer;
    for (Index i = 0; i < n; ++i) {
        surface.triangles.row(i) << 0, 1 + i, 1 + (i + 1) % n;
        outer.push_back(1 + i);
        if (i == 0) outer.push_back(n + 1);
    }
    const Index tip = n + 1, hole = n + 2;
    surface.triangles.bottomRows(6) << 2, 1, hole, 1, hole + 1, hole, 1, tip, hole + 1, tip, hole + 2, hole + 1, tip, 2,
        hole + 2, 2, hole, hole + 2;
    surface = require_bordered_genus_zero(surface.triangles, n + 5);
    ASSERT_EQ(surface.loops.size(), 2u);
    const VectorXd room = least_arcs(surface, outer, {}, {});
    const double mean = 2.0 * std::numbers::pi / static_cast<double>(room.size());
    for (Eigen::Index i = 0; i < room.size(); ++i) EXPECT_NEAR(room[i], i < 2 ? 1e-3 : 1e-3 * mean, 1e-15) << i;
}
