#include "circle_domain.h"
#include "core/errors.h"
#include "holes/fair_filling.h"
#include "mesh/topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace koebe;
using namespace koebe::test;

namespace {

/// The unit disk with a hole of radius 0.4 that is not in its middle.
CircleDomain one_hole() { return make_circle_domain({{{0.0, 0.0}, 1.0}, {{0.2, 0.1}, 0.4}}, 2000); }

Index count(const Vertices& vertices) { return static_cast<Index>(vertices.rows()); }

/// Rank of the hole of `one_hole`: the loop that is not on the unit circle.
Index rank_of_hole(const CircleDomain& domain)
{
    const Surface surface = analyze_surface(domain.triangles, static_cast<Index>(domain.points.size()));
    return std::abs(domain.points[surface.loops[0][0]]) < 0.9 ? 0 : 1;
}

}  // namespace

TEST(HoleFairing, a_cap_of_a_sphere_is_continued)
{
    const CircleDomain domain = one_hole();
    const Vertices sphere = lift(domain.points, Lift::sphere);
    const std::vector<Index> hole{rank_of_hole(domain)};
    const FilledSurface filled = fill_and_fair_holes(sphere, domain.triangles, hole);
    const Eigen::Index added = filled.vertices.rows() - sphere.rows();
    ASSERT_GT(added, 100);
    const VectorXd radius = filled.vertices.bottomRows(added).rowwise().norm();
    EXPECT_LT((radius.array() - 1.0).abs().maxCoeff(), 0.02);  // a flat lid is 0.1 inside
}

TEST(HoleFairing, a_flat_hole_stays_flat)
{
    const CircleDomain domain = one_hole();
    const Vertices plane = lift(domain.points, Lift::plane);
    const FilledSurface filled = fill_and_fair_holes(plane, domain.triangles, std::vector<Index>{rank_of_hole(domain)});
    EXPECT_GT(filled.vertices.rows(), plane.rows());
    EXPECT_LT(filled.vertices.col(2).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(HoleFairing, the_labels_are_the_loops_and_the_surface_is_closed_in_one_orientation)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 1200);
    const Vertices sphere = lift(domain.points, Lift::sphere);
    const Surface before = analyze_surface(domain.triangles, count(sphere));
    const FilledSurface filled = fill_and_fair_holes(sphere, domain.triangles);
    const Surface after = analyze_surface(filled.triangles, count(filled.vertices));
    EXPECT_EQ(after.euler_characteristic, 2);
    EXPECT_TRUE(after.loops.empty());
    EXPECT_TRUE(after.reoriented.empty());
    EXPECT_EQ(filled.vertices.topRows(sphere.rows()), sphere);
    EXPECT_EQ(filled.triangles.topRows(domain.triangles.rows()), domain.triangles);
    ASSERT_EQ(static_cast<Eigen::Index>(filled.label.size()), filled.triangles.rows());
    EXPECT_EQ(std::count(filled.label.begin(), filled.label.end(), -1), domain.triangles.rows());
    for (std::size_t f = domain.triangles.rows(); f < filled.label.size(); ++f) {
        const VertexLoop& loop = before.loops.at(filled.label[f]);
        for (const Index v : filled.triangles.row(f))
            EXPECT_TRUE(v >= sphere.rows() || std::find(loop.begin(), loop.end(), v) != loop.end());
    }
}

TEST(HoleFairing, only_the_loops_asked_for_are_filled)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 1200);
    const Vertices sphere = lift(domain.points, Lift::sphere);
    const Surface before = analyze_surface(domain.triangles, count(sphere));
    const FilledSurface filled = fill_and_fair_holes(sphere, domain.triangles, std::vector<Index>{3, 1, 3});
    EXPECT_EQ(analyze_surface(filled.triangles, count(filled.vertices)).loops,
              (std::vector<VertexLoop>{before.loops[0], before.loops[2], before.loops[4]}));
    EXPECT_THROW(fill_and_fair_holes(sphere, domain.triangles, std::vector<Index>{5}), InputError);
}

TEST(HoleFairing, a_long_loop_gets_a_coarser_patch_without_spikes)
{
    const CircleDomain ring = make_round_annulus(0.95, 800, 6);
    const Vertices sphere = lift(0.42 * ring.points, Lift::sphere);
    const FilledSurface filled = fill_and_fair_holes(sphere, ring.triangles, std::vector<Index>{1});
    const Eigen::Index added = filled.triangles.rows() - ring.triangles.rows();
    EXPECT_GT(added, 5000);
    EXPECT_LT(added, 20000);
    EXPECT_LT((filled.vertices.rowwise().norm().array() - 1.0).abs().maxCoeff(), 0.03);
}

TEST(HoleFairing, the_unit_changes_nothing)
{
    const CircleDomain domain = one_hole();
    const Vertices sphere = lift(domain.points, Lift::sphere);
    const FilledSurface filled = fill_and_fair_holes(sphere, domain.triangles);
    for (const double unit : {0x1p-500, 0x1p-26, 0x1p500}) {
        const FilledSurface other = fill_and_fair_holes(unit * sphere, domain.triangles);
        EXPECT_EQ(other.triangles, filled.triangles) << unit;
        EXPECT_EQ(other.vertices, unit * filled.vertices) << unit;
    }
}

TEST(HoleFairing, a_loop_without_extent_is_named)
{
    const CircleDomain domain = one_hole();
    Vertices sphere = lift(domain.points, Lift::sphere);
    const Index rank = rank_of_hole(domain);
    const VertexLoop loop = analyze_surface(domain.triangles, count(sphere)).loops[rank];
    for (const Index v : loop) sphere.row(v) = sphere.row(loop[0]).eval();
    try {
        fill_and_fair_holes(sphere, domain.triangles, std::vector<Index>{rank});
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.elements(), loop);
    }
}

TEST(HoleFairing, doubled_vertices_end_and_stay_where_they_are)
{
    const CircleDomain domain = one_hole();
    Vertices sphere = lift(domain.points, Lift::sphere);
    const Index rank = rank_of_hole(domain);
    const VertexLoop loop = analyze_surface(domain.triangles, count(sphere)).loops[rank];
    for (const int i : {1, 2, 9}) sphere.row(loop[i]) = sphere.row(loop[i - 1]).eval();
    const FilledSurface filled = fill_and_fair_holes(sphere, domain.triangles, std::vector<Index>{rank});
    EXPECT_EQ(filled.vertices.topRows(sphere.rows()), sphere);
    EXPECT_LT((filled.vertices.rowwise().norm().array() - 1.0).abs().maxCoeff(), 0.03);

    sphere.row(loop[20]) = sphere.row(loop[5]).eval();
    EXPECT_THROW(fill_and_fair_holes(sphere, domain.triangles, std::vector<Index>{rank}), InputError);
}
