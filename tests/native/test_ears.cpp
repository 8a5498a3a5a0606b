#include "circle_domain.h"
#include "ear_domain.h"
#include "ears/ears.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace koebe;
using namespace koebe::test;

namespace {

EarCut cut(const CircleDomain& domain)
{
    const Surface surface = require_bordered_genus_zero(domain.triangles, static_cast<Index>(domain.points.size()));
    return cut_ears(lift(domain.points, Lift::plane), surface, domain.loops);
}

}  // namespace

TEST(Ears, a_mesh_without_chords_has_none)
{
    const EarCut result = cut(make_circle_domain(five_circles(), 1000));
    EXPECT_TRUE(result.ears.empty());
    EXPECT_TRUE(result.vertices.empty());
}

TEST(Ears, nested_ears_of_a_loop_are_one_ear_and_the_rest_is_the_domain_without_them)
{
    const CircleDomain plain = make_circle_domain(five_circles(), 1000);
    CircleDomain domain = plain;
    const Index a = domain.loops[1][3], b = domain.loops[1][4];
    const Index tip = glue_ear(domain, 1, a, b, 0.5);
    const Index second = glue_ear(domain, 1, a, tip, 0.3);

    const EarCut result = cut(domain);
    ASSERT_EQ(result.ears.size(), 1u);
    const Ear& ear = result.ears[0];
    EXPECT_EQ(ear.loop, 1);
    EXPECT_EQ(ear.first, a);
    EXPECT_EQ(ear.last, b);
    EXPECT_EQ(ear.rim, (std::vector<Index>{second, tip}));
    EXPECT_TRUE(ear.interior.empty());
    EXPECT_EQ(ear.faces.size(), 2u);
    EXPECT_EQ((result.core.triangles - plain.triangles).cwiseAbs().maxCoeff(), 0);
    EXPECT_EQ(result.loops, plain.loops);
}

TEST(Ears, of_a_strip_of_triangles_the_largest_one_stays)
{
    const CircleDomain strip = strip_of_triangles();
    const EarCut result = cut(strip);
    ASSERT_EQ(result.ears.size(), 2u);
    EXPECT_EQ(result.vertices, (std::vector<Index>{2, 3, 4}));
    EXPECT_EQ(result.loops[0].size(), 3u);
    std::vector<Index> faces;
    for (const Ear& ear : result.ears) faces.insert(faces.end(), ear.faces.begin(), ear.faces.end());
    std::sort(faces.begin(), faces.end());
    EXPECT_EQ(faces, (std::vector<Index>{0, 1, 3, 4}));
}

TEST(Ears, what_has_another_loop_behind_its_edge_is_none)
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
    EXPECT_TRUE(cut_ears(lift(both.points, Lift::plane), surface, surface.loops).ears.empty());
}
