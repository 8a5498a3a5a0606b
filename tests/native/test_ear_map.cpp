#include "circle_domain.h"
#include "ear_domain.h"
#include "planar/planar_predicates.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace koebe;
using namespace koebe::test;

namespace {

Complex at(const UniformizeResult& result, Index v) { return {result.uv(v, 0), result.uv(v, 1)}; }

/// Every vertex is on its circle or listed, nothing is flipped, and no boundary edges cross: with that the map is
/// one to one.
void expect_one_to_one(const UniformizeResult& result)
{
    EXPECT_TRUE(result.distortion.flipped.empty());
    std::vector<std::pair<Index, Index>> edges;
    for (const LoopReport& loop : result.loops)
        for (std::size_t i = 0; i < loop.vertices.size(); ++i) {
            const Index v = loop.vertices[i];
            edges.emplace_back(v, loop.vertices[(i + 1) % loop.vertices.size()]);
            if (std::find(loop.off_circle.begin(), loop.off_circle.end(), v) == loop.off_circle.end()) {
                EXPECT_NEAR(std::abs(at(result, v) - loop.circle.center), loop.circle.radius, 1e-12) << v;
            }
        }
    for (std::size_t i = 0; i < edges.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const auto [a, b] = edges[i];
            const auto [c, d] = edges[j];
            if (a != c && a != d && b != c && b != d) {
                EXPECT_FALSE(segments_meet(at(result, a), at(result, b), at(result, c), at(result, d)));
            }
        }
}

}  // namespace

TEST(EarMap, an_ear_hangs_into_its_hole_in_its_own_shape)
{
    CircleDomain domain = make_circle_domain(five_circles(), 1000);
    const Index a = domain.loops[1][3], b = domain.loops[1][4];
    const Index tip = glue_ear(domain, 1, a, b, 0.5);
    const UniformizeResult result = map_flat(domain);
    expect_one_to_one(result);
    std::vector<Index> off_circle;
    for (const LoopReport& loop : result.loops)
        off_circle.insert(off_circle.end(), loop.off_circle.begin(), loop.off_circle.end());
    EXPECT_EQ(off_circle, std::vector<Index>{tip});
    const Complex shape = (at(result, tip) - at(result, a)) / (at(result, b) - at(result, a));
    const Complex wanted = (domain.points[tip] - domain.points[a]) / (domain.points[b] - domain.points[a]);
    EXPECT_LT(std::abs(shape - wanted), 1e-9);
    ASSERT_EQ(result.warnings.size(), 1u);
    EXPECT_NE(result.warnings[0].text().find("the first " + std::to_string(tip)), std::string::npos)
        << result.warnings[0].text();
}

TEST(EarMap, ears_that_would_meet_across_the_hole_are_made_flatter)
{
    CircleDomain domain = make_circle_domain(five_circles(), 1000);
    const VertexLoop loop = domain.loops[3];
    for (std::size_t i = 0; i < loop.size(); ++i) glue_ear(domain, 3, loop[i], loop[(i + 1) % loop.size()], 6.0);
    const UniformizeResult result = map_flat(domain);
    expect_one_to_one(result);
    for (const LoopReport& report : result.loops)
        EXPECT_TRUE(report.off_circle.empty() || report.off_circle.size() == loop.size());
}

TEST(EarMap, on_the_outer_loop_ears_lie_along_the_unit_circle)
{
    CircleDomain domain = make_circle_domain(five_circles(), 1000);
    const Index a = domain.loops[0][7], b = domain.loops[0][8];
    const Index tip = glue_ear(domain, 0, a, b, 0.8);
    glue_ear(domain, 0, a, tip, 0.8);
    glue_ear(domain, 0, tip, b, 0.8);
    const UniformizeResult result = map_flat(domain);
    expect_one_to_one(result);
    for (const LoopReport& report : result.loops) EXPECT_TRUE(report.off_circle.empty());
}

TEST(EarMap, a_strip_without_inner_vertices_becomes_a_convex_polygon)
{
    CircleDomain strip = strip_of_triangles();
    expect_one_to_one(map_flat(strip));
    strip.points.conservativeResize(3);
    strip.triangles.conservativeResize(1, 3);
    strip.triangles << 0, 2, 1;
    strip.loops = {{0, 2, 1}};
    expect_one_to_one(map_flat(strip));
}

TEST(EarMap, segments_that_touch_or_lie_on_each_other_meet)
{
    EXPECT_TRUE(segments_meet({0, 0}, {2, 2}, {0, 2}, {2, 0}));
    EXPECT_TRUE(segments_meet({0, 0}, {2, 0}, {1, 0}, {1, 5}));
    EXPECT_TRUE(segments_meet({0, 0}, {2, 0}, {1, 0}, {3, 0}));
    EXPECT_FALSE(segments_meet({0, 0}, {2, 0}, {3, 0}, {5, 0}));
    EXPECT_FALSE(segments_meet({0, 0}, {2, 0}, {0, 1}, {2, 1}));
    EXPECT_FALSE(segments_meet({0, 0}, {2, 0}, {3, -1}, {3, 1}));
}
