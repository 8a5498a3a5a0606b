#include "foldover/untangle.h"
#include "planar_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <set>

using namespace koebe;
using namespace koebe::test;

namespace {

struct Tangled : PlanarMap {
    using PlanarMap::PlanarMap;

    UntangleReport run(const UntangleOptions& options = {})
    {
        return untangle(vertices, surface, domain.loops, domain.circles, {}, uv, {}, options);
    }
};

/// A hole of eight corners, five sides of which one vertex alone sees: too many for any place outside the hole, as the
/// first and the last of them run in opposite directions.
CircleDomain wide_fan()
{
    CircleDomain domain;
    domain.circles = {Circle{}, {{0.0, 0.0}, 0.4}};
    constexpr Index outer = 16, hole = 8;
    domain.points.resize(outer + hole + 1);
    for (Index i = 0; i < outer; ++i) domain.points[i] = std::polar(1.0, 2.0 * std::numbers::pi * i / outer);
    for (Index i = 0; i < hole; ++i)
        domain.points[outer + i] = std::polar(0.4, 2.0 * std::numbers::pi * (i - 2.5) / hole);
    const Index w = outer + hole;  // sees hole vertices 0 to 5, at angles -112.5 to 112.5 degrees
    domain.points[w] = 0.75;
    std::vector<std::array<Index, 3>> faces;
    for (Index i = 0; i < 5; ++i) faces.push_back({w, outer + i + 1, outer + i});
    // Round the fan, each with the rim vertex where its turn begins.
    const std::array<std::pair<Index, Index>, 5> inner = {
        {{w, 0}, {outer + 5, 4}, {outer + 6, 6}, {outer + 7, 9}, {outer + 0, 12}}};
    for (std::size_t s = 0; s < inner.size(); ++s) {
        const auto [v, begin] = inner[s];
        const auto [next, end] = inner[(s + 1) % inner.size()];
        for (Index i = begin; i != end; i = (i + 1) % outer) faces.push_back({v, i, (i + 1) % outer});
        faces.push_back({v, end, next});
    }
    domain.triangles.resize(static_cast<Eigen::Index>(faces.size()), 3);
    for (std::size_t f = 0; f < faces.size(); ++f) domain.triangles.row(f) << faces[f][0], faces[f][1], faces[f][2];
    VertexLoop rim, around;
    for (Index i = 0; i < outer; ++i) rim.push_back(i);
    for (Index i = 0; i < hole; ++i) around.push_back(outer + hole - 1 - i);
    domain.loops = {rim, around};
    return domain;
}

}  // namespace

TEST(Untangle, a_map_without_flips_is_left_alone)
{
    Tangled map(make_circle_domain(five_circles(), 1000));
    const PlanarPoints before = map.uv;
    const UntangleReport report = map.run();
    EXPECT_EQ(report.repairs, 0);
    EXPECT_EQ((map.uv - before).cwiseAbs().maxCoeff(), 0.0);
}

TEST(Untangle, a_folded_vertex_comes_back_and_only_its_neighbourhood_moves)
{
    Tangled map(make_circle_domain(five_circles(), 2000));
    Index folded = -1;  // an inner vertex near the middle
    for (Eigen::Index v = 0; v < map.uv.rows(); ++v)
        if (std::abs(map.domain.points[v] - Complex(0.05, 0.0)) < 0.05) folded = static_cast<Index>(v);
    ASSERT_GE(folded, 0);
    map.uv.row(folded) += Eigen::RowVector2d(0.1, 0.02);
    const PlanarPoints before = map.uv;
    ASSERT_FALSE(flipped_faces(map.domain.triangles, map.uv).empty());
    const UntangleReport report = map.run();
    EXPECT_TRUE(flipped_faces(map.domain.triangles, map.uv).empty());
    EXPECT_TRUE(report.freed.empty());
    EXPECT_TRUE(report.tangled.empty());
    for (const VertexLoop& loop : map.domain.loops)
        for (const Index v : loop) EXPECT_EQ(map.uv.row(v), before.row(v));
    for (Eigen::Index v = 0; v < map.uv.rows(); ++v)
        if (std::abs(map.domain.points[v] - map.domain.points[folded]) > 0.35) {
            EXPECT_EQ(map.uv.row(v), before.row(v));
        }
}

TEST(Untangle, loop_vertices_slide_along_their_circle_where_a_vertex_sees_more_than_half_of_it)
{
    Tangled map(wide_fan());
    ASSERT_FALSE(flipped_faces(map.domain.triangles, map.uv).empty());
    const UntangleReport report = map.run();
    EXPECT_TRUE(flipped_faces(map.domain.triangles, map.uv).empty());
    EXPECT_TRUE(report.freed.empty());
    for (std::size_t k = 0; k < 2; ++k)
        for (const Index v : map.domain.loops[k]) EXPECT_NEAR(map.uv.row(v).norm(), k == 0 ? 1.0 : 0.4, 1e-12);
}

TEST(Untangle, where_they_may_not_slide_a_few_are_freed_and_listed)
{
    Tangled map(wide_fan());
    const UntangleReport report = map.run({.slide = false});
    EXPECT_TRUE(flipped_faces(map.domain.triangles, map.uv).empty());
    EXPECT_GE(report.freed.size(), 1u);
    EXPECT_LE(report.freed.size(), 3u);
    const std::set<Index> freed(report.freed.begin(), report.freed.end());
    for (const Index v : map.domain.loops[1]) {
        if (freed.count(v)) {
            EXPECT_GT(std::abs(map.uv.row(v).norm() - 0.4), 1e-6);
        } else {
            EXPECT_NEAR(map.uv.row(v).norm(), 0.4, 1e-6);
        }
    }
}

TEST(Untangle, a_sliver_on_the_rim_too_thin_for_32_bits_is_kept_within_what_counts_as_on_the_circle)
{
    // Two corners of a disk 4e-5 apart, and one between them, turned until rounding flips their face.
    CircleDomain domain;
    domain.circles = {Circle{}};
    domain.points.resize(6);
    domain.points[5] = 0.0;
    domain.triangles.resize(5, 3);
    domain.triangles << 0, 1, 2, 0, 2, 5, 2, 3, 5, 3, 4, 5, 4, 0, 5;
    domain.loops = {{0, 1, 2, 3, 4}};
    for (double turn = 0.0; turn < 0.3; turn += 0.01) {
        const double angles[] = {turn, turn + 2e-5, turn + 4e-5, 2.0, 4.0};
        for (int i = 0; i < 5; ++i) domain.points[i] = std::polar(1.0, angles[i]);
        if (!flipped_faces(domain.triangles, lift(domain.points, Lift::plane).leftCols<2>()).empty()) break;
    }
    Tangled map(domain);
    ASSERT_EQ(flipped_faces(domain.triangles, map.uv), std::vector<Index>{0});
    const UntangleReport report = map.run();
    EXPECT_TRUE(flipped_faces(domain.triangles, map.uv).empty());
    EXPECT_TRUE(report.freed.empty());
    for (const Index v : domain.loops[0]) EXPECT_NEAR(map.uv.row(v).norm(), 1.0, 1e-6);
}

TEST(Untangle, what_cannot_be_turned_back_costs_no_more_than_the_effort_and_is_not_tried_twice)
{
    // A third of the disk folded over to where its border cannot follow.
    const auto folded = [] {
        Tangled map(make_circle_domain(five_circles(), 400));
        for (const VertexLoop& loop : map.domain.loops)
            for (const Index v : loop) map.uv(v, 0) *= -1.0;
        return map;
    };
    std::size_t spent_by_all = 0;
    for (const double share : {1.0, 0.2}) {
        Tangled map = folded();
        RepairEffort effort(map.domain.triangles.rows());
        EXPECT_FALSE(map.run({.effort = &effort, .share = share}).tangled.empty());
        EXPECT_GT(effort.spent(), 0u);
        EXPECT_LE(static_cast<double>(effort.spent()), share * static_cast<double>(effort.most()));
        if (share == 1.0) spent_by_all = effort.spent();
    }
    EXPECT_LE(spent_by_all, static_cast<std::size_t>(30 * folded().domain.triangles.rows() + 100000));

    // Four corners of a square in the wrong order: few problems, each posed once.
    Tangled fan(wide_fan());
    for (const VertexLoop& loop : fan.domain.loops)
        for (const Index v : loop) fan.uv(v, 0) *= -1.0;
    std::vector<Index> held;
    for (const VertexLoop& loop : fan.domain.loops) held.insert(held.end(), loop.begin(), loop.end());
    RepairEffort effort(fan.domain.triangles.rows(), 1000000);
    fan.run({.held = held, .effort = &effort});
    const std::size_t once = effort.spent();
    fan.run({.held = held, .effort = &effort});
    EXPECT_GT(once, 0u);
    EXPECT_EQ(effort.spent(), once);
}

TEST(Untangle, an_effort_that_is_renewed_allows_as_much_again)
{
    RepairEffort effort(1000);
    const std::size_t all = effort.most();
    const int step = effort.affordable(1000);
    while (!effort.exhausted()) effort.spend(1000, effort.affordable(1000) > 0 ? effort.affordable(1000) : 1);
    effort.renew();
    EXPECT_EQ(effort.left(), all);
    EXPECT_EQ(effort.affordable(1000), step);
    EXPECT_FALSE(effort.exhausted());
}
