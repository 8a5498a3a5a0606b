#include "circle_domain.h"
#include "flap_domain.h"
#include "flaps/flaps.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace koebe;
using namespace koebe::test;

namespace {

FlapCut cut(const CircleDomain& domain)
{
    const Surface surface = require_bordered_genus_zero(domain.triangles, static_cast<Index>(domain.points.size()));
    return cut_flaps(lift(domain.points, Lift::plane), surface, domain.loops);
}

}  // namespace

TEST(Flaps, a_mesh_without_chords_has_none)
{
    const FlapCut result = cut(make_circle_domain(five_circles(), 1000));
    EXPECT_TRUE(result.flaps.empty());
    EXPECT_TRUE(result.vertices.empty());
}

TEST(Flaps, nested_ears_of_a_loop_are_one_flap_and_the_rest_is_the_domain_without_them)
{
    const CircleDomain plain = make_circle_domain(five_circles(), 1000);
    CircleDomain domain = plain;
    const Index a = domain.loops[1][3], b = domain.loops[1][4];
    const Index tip = glue_ear(domain, 1, a, b, 0.5);
    const Index second = glue_ear(domain, 1, a, tip, 0.3);

    const FlapCut result = cut(domain);
    ASSERT_EQ(result.flaps.size(), 1u);
    const Flap& flap = result.flaps[0];
    EXPECT_EQ(flap.loop, 1);
    EXPECT_EQ(flap.first, a);
    EXPECT_EQ(flap.last, b);
    EXPECT_EQ(flap.rim, (std::vector<Index>{second, tip}));
    EXPECT_TRUE(flap.interior.empty());
    EXPECT_EQ(flap.faces.size(), 2u);
    EXPECT_EQ((result.core.triangles - plain.triangles).cwiseAbs().maxCoeff(), 0);
    EXPECT_EQ(result.loops, plain.loops);
}

TEST(Flaps, of_a_strip_of_triangles_the_largest_one_stays)
{
    const CircleDomain strip = strip_of_triangles();
    const FlapCut result = cut(strip);
    ASSERT_EQ(result.flaps.size(), 2u);
    EXPECT_EQ(result.vertices, (std::vector<Index>{2, 3, 4}));
    EXPECT_EQ(result.loops[0].size(), 3u);
    std::vector<Index> faces;
    for (const Flap& flap : result.flaps) faces.insert(faces.end(), flap.faces.begin(), flap.faces.end());
    std::sort(faces.begin(), faces.end());
    EXPECT_EQ(faces, (std::vector<Index>{0, 1, 3, 4}));
}

TEST(Flaps, what_has_another_loop_behind_its_edge_is_none)
{
    // Two annuli that share one edge of their outer loops.
    const CircleDomain one = make_round_annulus(0.5, 12, 3);
    CircleDomain both;
    const Index n = static_cast<Index>(one.points.size());
    both.points.resize(2 * n);
    both.points << one.points, one.points.array() + Complex(3.0, 0.0);
    const auto renamed = [&](Index v) { return v == 0 ? Index{1} : v == 1 ? Index{0} : v + n; };
    both.triangles.resize(2 * one.triangles.rows(), 3);
    both.triangles.topRows(one.triangles.rows()) = one.triangles;
    for (Eigen::Index f = 0; f < one.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) both.triangles(one.triangles.rows() + f, k) = renamed(one.triangles(f, k));
    const Surface surface = require_bordered_genus_zero(both.triangles, 2 * n);
    EXPECT_EQ(surface.loops.size(), 3u);
    EXPECT_TRUE(cut_flaps(lift(both.points, Lift::plane), surface, surface.loops).flaps.empty());
}
