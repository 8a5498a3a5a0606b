#include "circle_domain.h"
#include "core/errors.h"
#include "execution/memory_limit.h"
#include "pipeline/final_check.h"
#include "pipeline/refinement.h"
#include "pipeline/uniformize.h"
#include "planar/boundary_crossings.h"
#include "planar_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace koebe;
using namespace koebe::test;

/// A good map with one thing made wrong.
class Promise : public testing::Test {
protected:
    CircleDomain domain = make_circle_domain(five_circles(), 800);
    PlanarPoints uv = planar(domain.points);
    std::vector<Circle> circles = domain.circles;
    MapFaults faults() const { return find_faults(domain.triangles, domain.loops, uv, circles); }
    Index inner_vertex() const { return static_cast<Index>(domain.points.size()) - 1; }
};

TEST_F(Promise, a_circle_domain_keeps_it)
{
    uv *= 1.0 - 1e-15;
    EXPECT_FALSE(faults().any());
    EXPECT_FALSE(loops_cross(domain.loops, uv, 0.0));
}

TEST_F(Promise, what_is_not_finite_is_named)
{
    uv(inner_vertex(), 1) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(faults().not_finite, std::vector<Index>{inner_vertex()});
}

TEST_F(Promise, what_lies_outside_the_disk_is_named)
{
    const Index v = domain.loops[0][3];
    uv.row(v) *= 1.0 + 1e-9;
    EXPECT_EQ(faults().outside, std::vector<Index>{v});
}

TEST_F(Promise, flips_are_found)
{
    uv.row(inner_vertex()) = uv.row(domain.loops[0][0]);
    EXPECT_FALSE(faults().flipped.empty());
}

TEST_F(Promise, circles_are_positive_inside_and_apart)
{
    circles[1].radius = -circles[1].radius;
    EXPECT_EQ(faults().bad_circles, std::vector<int>{1});
    circles = domain.circles;
    circles[2].center = {0.99, 0.0};
    EXPECT_EQ(faults().bad_circles, std::vector<int>{2});
    circles = domain.circles;
    circles[3].center = circles[4].center;
    EXPECT_EQ(faults().bad_circles, (std::vector<int>{3, 4}));
}

TEST_F(Promise, a_loop_that_crosses_another_is_found)
{
    // The vertex of one hole across another hole.
    const Index v = domain.loops[1][0];
    const Complex far = 1.9 * domain.circles[2].center - 0.9 * Complex(uv(v, 0), uv(v, 1));
    uv.row(v) << far.real(), far.imag();
    ASSERT_FALSE(faults().crossings.empty());
    EXPECT_TRUE(loops_cross(domain.loops, uv, 0.0));
}

TEST_F(Promise, a_hole_turned_over_is_found_however_narrow_but_not_below_resolution)
{
    const VertexLoop& hole = domain.loops[1];
    const auto narrow = [&](double length, double turn) {
        for (std::size_t i = 0; i < hole.size(); ++i) {
            const double angle = turn * 2.0 * EIGEN_PI * static_cast<double>(i) / static_cast<double>(hole.size());
            const Complex at = circles[1].center + Complex(length * std::cos(angle), 1e-9 * std::sin(angle));
            uv.row(hole[i]) << at.real(), at.imag();
        }
        return faults().bad_circles;
    };
    EXPECT_EQ(narrow(1e-2, 1.0), std::vector<int>{1});
    EXPECT_TRUE(narrow(1e-2, -1.0).empty());
    EXPECT_TRUE(narrow(1e-7, 1.0).empty());
}

TEST(BoundaryCrossings, of_a_figure_eight_is_one)
{
    PlanarPoints points(4, 2);
    points << 0, 0, 1, 1, 1, 0, 0, 1;
    const auto crossings = crossing_boundary_edges({{0, 1, 2, 3}}, points, 0.0);
    ASSERT_EQ(crossings.size(), 1u);
    EXPECT_EQ(crossings[0], (std::pair<Index, Index>(0, 2)));
    EXPECT_TRUE(crossing_boundary_edges({{0, 2, 1, 3}}, points, 0.0).empty());
}

TEST(BoundaryCrossings, edges_beside_a_short_edge_meet_without_crossing)
{
    PlanarPoints points(5, 2);
    points << 0, 0, 1, 0, 1, 1, 1, 1, 0, 1;
    EXPECT_FALSE(loops_cross({{0, 1, 2, 3, 4}}, points, 1e-7));
    EXPECT_FALSE(loops_cross({{3, 4, 0, 1, 2}}, points, 1e-7));
    points.row(4) << 2, 0.5;  // now the edges beside it cross others
    EXPECT_TRUE(loops_cross({{0, 1, 2, 3, 4}}, points, 1e-7));
}

TEST(BoundaryCrossings, a_hole_that_runs_as_its_rim_does_is_turned)
{
    PlanarPoints points(8, 2);
    points << 0, 0, 4, 0, 4, 4, 0, 4,  // a square
        1, 1, 2, 1, 2, 2, 1, 2;        // and one in it
    const VertexLoop rim{0, 1, 2, 3}, rim_back{3, 2, 1, 0}, hole{7, 6, 5, 4}, turned{4, 5, 6, 7};
    EXPECT_TRUE(turned_loops({rim, hole}, points, 0.0).empty());
    EXPECT_TRUE(turned_loops({rim_back, turned}, points, 0.0).empty());
    EXPECT_EQ(turned_loops({rim, turned}, points, 0.0), std::vector<int>{1});
    EXPECT_EQ(turned_loops({hole, rim_back}, points, 0.0), std::vector<int>{0});
    EXPECT_TRUE(turned_loops({rim, turned}, points, 1.0).empty());  // too narrow to be told from a line
}

TEST(RefinedInput, has_the_same_metric_and_every_second_loop_vertex)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 300);
    const MapInput coarse = prepare_input(lift(domain.points, Lift::enneper), domain.triangles, {});
    const MapInput fine = refined_input(coarse);
    EXPECT_EQ(fine.surface.triangles.rows(), 4 * coarse.surface.triangles.rows());
    const Surface checked = analyze_surface(fine.surface.triangles, fine.surface.vertex_count);
    EXPECT_EQ(checked.loops.size(), coarse.loops.size());
    EXPECT_EQ(checked.genus, 0);
    EXPECT_TRUE(checked.reoriented.empty());
    for (std::size_t k = 0; k < coarse.loops.size(); ++k) {
        EXPECT_NEAR(fine.edges[k].sum(), coarse.edges[k].sum(), 1e-12);
        for (std::size_t i = 0; i < coarse.loops[k].size(); ++i) EXPECT_EQ(fine.loops[k][2 * i], coarse.loops[k][i]);
    }
}

TEST(Uniformize, a_ring_without_inner_vertices_is_mapped_to_a_round_annulus)
{
    // Two concentric hexagons and nothing between: NaN without refinement.
    const CircleDomain ring = make_round_annulus(0.5, 6, 1);
    ExecutionContext context;
    const UniformizeResult result = uniformize(lift(ring.points, Lift::plane), ring.triangles, {}, context);
    EXPECT_TRUE(result.converged);
    EXPECT_TRUE(result.distortion.flipped.empty());
    EXPECT_LT(std::abs(result.loops[1].circle.center), 1e-9);
    EXPECT_NEAR(result.loops[1].circle.radius, 0.5, 0.05);
}

TEST(MemoryLimit, of_maps_is_about_what_was_measured)
{
    EXPECT_NEAR(memory_for_faces(656608) / 507e6, 1.0, 0.01);
    EXPECT_NEAR(memory_for_faces(2626432) / 2199e6, 1.0, 0.01);
    EXPECT_NEAR(memory_for_faces(10505728) / 9413e6, 1.0, 0.01);
    EXPECT_EQ(memory_for_faces(1), 0.0);
}

TEST(MemoryLimit, what_cannot_fit_is_refused_with_the_figure)
{
    EXPECT_GT(available_memory(), 0.0);
    EXPECT_NO_THROW(require_memory(1e6, "a test"));
    if (!std::isfinite(available_memory())) GTEST_SKIP() << "this system does not tell";
    try {
        require_memory(1e18, "a test");
        FAIL();
    } catch (const OutOfMemory& error) {
        EXPECT_STREQ(error.name(), "SolverError");
        EXPECT_NE(std::string(error.what()).find("1e+09 GB"), std::string::npos) << error.what();
    }
}
