#include "darts/darts.h"
#include "darts/tension.h"
#include "darts/through_rounds.h"
#include "even/even_forces.h"
#include "grids.h"
#include "packing/packing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

using namespace koebe;

namespace {

using std::numbers::pi;
constexpr double even = 0.1;

/// A part of two loops, drawn as a ring: what a turn of `radius(height)` sweeps out, of area 1.
FlatPart ring_part(int around, int rows, double (*radius)(double))
{
    const auto at = [&](int i, int j) { return static_cast<Index>(j * around + i % around); };
    Triangles triangles = test::grid(around, rows, at);
    triangles.col(1).swap(triangles.col(2));  // seen from inside
    FlatPart part = test::part_of(triangles);
    part.vertices.resize(around * (rows + 1), 3);
    part.points.resize(part.vertices.rows(), 2);
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i < around; ++i) {
            const double angle = 2.0 * pi * i / around, height = j / double(rows), r = radius(height);
            part.vertices.row(at(i, j)) << r * std::cos(angle), r * std::sin(angle), height;
            const Complex z = std::polar(0.2 + 0.4 * height, angle);
            part.points.row(at(i, j)) << z.real(), z.imag();
        }
    part.vertices /= std::sqrt(face_areas(part.vertices, part.surface.triangles).sum());
    return part;
}

/// A flat strip of area 1, of so many squares along and across.
FlatPart strip_part(int along, int across)
{
    const auto at = [&](int i, int j) { return static_cast<Index>(j * (along + 1) + i); };
    FlatPart part = test::part_of(test::grid(along, across, at));
    const double side = 1.0 / std::sqrt(static_cast<double>(along * across));
    part.points.resize((along + 1) * (across + 1), 2);
    for (int j = 0; j <= across; ++j)
        for (int i = 0; i <= along; ++i) part.points.row(at(i, j)) << side * i, side * j;
    part.vertices = Vertices::Zero(part.points.rows(), 3);
    part.vertices.leftCols<2>() = part.points;
    return part;
}

/// A flat regular polygon of area 1, all faces round its middle.
FlatPart fan_part(int sides)
{
    Triangles triangles(sides, 3);
    for (int i = 0; i < sides; ++i) triangles.row(i) << 0, i + 1, (i + 1) % sides + 1;
    FlatPart part = test::part_of(triangles);
    part.points = PlanarPoints::Zero(sides + 1, 2);
    const double radius = 1.0 / std::sqrt(0.5 * sides * std::sin(2.0 * pi / sides));
    for (int i = 0; i < sides; ++i) {
        const double angle = 2.0 * pi * i / sides;
        part.points.row(i + 1) << radius * std::cos(angle), radius * std::sin(angle);
    }
    part.vertices = Vertices::Zero(part.points.rows(), 3);
    part.vertices.leftCols<2>() = part.points;
    return part;
}

std::vector<HeldPart> cut_for_room(const FlatPart& part, const ThroughPrice& price)
{
    std::vector<HeldPart> parts{{part, {}}};
    ExecutionContext context;
    cut_parts_for_room(parts, price, 1, context);
    return parts;
}

double packed_scale(const std::vector<HeldPart>& parts)
{
    std::vector<Outline> outlines;
    for (const HeldPart& part : parts) outlines.push_back({part.flat.points, part.flat.surface.loops, false});
    return pack_islands(outlines, 0.004).scale;
}

double energy(const FlatPart& flat)
{
    return even_forces(flat.vertices, flat.surface.triangles, flat.points, even).energy.sum();
}

void relax(FlatPart& part)
{
    ExecutionContext context;
    std::vector<RoundLoop> none;
    ASSERT_TRUE(make_even({part.vertices, part.surface.triangles, part.surface.loops, part.points, none}, even,
                          packed_side, context)
                    .moved);
}

std::vector<HeldPart> cut(const FlatPart& part, const ThroughPrice& price)
{
    std::vector<HeldPart> parts{{part, {}}};
    ExecutionContext context;
    cut_parts_through(parts, even, price, 1, context);
    return parts;
}

}  // namespace

TEST(ThroughCuts, a_rolled_panel_is_cut_along_once_and_lies_flat)
{
    FlatPart part = ring_part(32, 8, [](double) { return 0.5; });
    relax(part);
    const double before = energy(part);
    ASSERT_GT(before, 1e-3);
    const std::vector<HeldPart> parts = cut(part, {5e-4, 5e-4});
    ASSERT_EQ(parts.size(), 1U);
    FlatPart open = parts[0].flat;
    EXPECT_EQ(open.surface.loops.size(), 1U);
    EXPECT_EQ(open.faces, part.faces);
    EXPECT_GE(open.slit, 1.0 / std::sqrt(pi) - 1e-3);  // its height, of area 1,
    EXPECT_LE(open.slit, 1.1 / std::sqrt(pi));         // along edges
    EXPECT_LT(energy(open), 1e-2 * before);
    EXPECT_TRUE(lies_one_to_one(open, open.points));
    relax(open);
    EXPECT_LT(energy(open), 1e-9 * before);
}

TEST(ThroughCuts, what_is_true_to_size_is_neither_moved_nor_cut_however_thin_its_faces)
{
    FlatPart part = fan_part(1000);
    const PlanarPoints before = part.points;
    relax(part);
    EXPECT_EQ(part.points, before);
    EXPECT_TRUE(promising_through_cuts(part, even, {1e-12, 1e-12}, {}).empty());
    EXPECT_TRUE(promising_darts(part, forces_in(part, even), even, 1e-12, {}).empty());
}

TEST(ThroughCuts, what_costs_more_than_it_releases_is_not_cut)
{
    FlatPart part = ring_part(32, 8, [](double) { return 0.5; });
    relax(part);
    const std::vector<HeldPart> parts = cut(part, {1e3, 1e3});
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].flat.points, part.points);
    EXPECT_EQ(parts[0].flat.slit, 0.0);
}

TEST(ThroughCuts, cuts_that_are_opened_together_split_nothing_and_refused_ones_do_not_come_back)
{
    FlatPart part = ring_part(32, 8, [](double) { return 0.5; });
    relax(part);
    const std::vector<ThroughCut> first = promising_through_cuts(part, even, {5e-4, {}}, {});
    ASSERT_EQ(first.size(), 1U);  // of 32 that are as good: two would split the panel
    const std::vector<ThroughCut> second = promising_through_cuts(part, even, {5e-4, {}}, {first[0].ends});
    ASSERT_EQ(second.size(), 1U);
    EXPECT_GT((second[0].ends.from - first[0].ends.from).norm(), tuning::cut_reach * second[0].length);
}

TEST(ThroughCuts, pieces_are_the_part_and_without_a_price_of_pieces_nothing_is_split)
{
    FlatPart part = ring_part(24, 24, [](double h) { return 0.3 - 0.25 * std::sin(2.0 * pi * h); });
    relax(part);
    EXPECT_EQ(cut(part, {1e-5, {}}).size(), 1U);
    EXPECT_FALSE(promising_through_cuts(part, even, {1e-5, 1e-5}, {}).empty());
    for (const ThroughPrice& price : {ThroughPrice{1e-5, {}}, ThroughPrice{1e-5, 1e-5}})
        for (const ThroughCut& promising : promising_through_cuts(part, even, price, {}))
            EXPECT_LT(promising.cost, promising.forecast);
    const std::vector<HeldPart> parts = cut(part, {1e-5, 1e-5});
    ASSERT_GT(parts.size(), 1U);
    std::multiset<Index> faces;
    double after = 0.0;
    for (const HeldPart& held : parts) {
        const FlatPart& flat = held.flat;
        faces.insert(flat.faces.begin(), flat.faces.end());
        after += energy(flat);
        EXPECT_TRUE(lies_one_to_one(flat, flat.points));
        for (std::size_t f = 0; f < flat.faces.size(); ++f)
            for (int k = 0; k < 3; ++k) {
                const Index v = flat.surface.triangles(static_cast<Eigen::Index>(f), k);
                EXPECT_EQ(flat.original[v], part.surface.triangles(flat.faces[f], k));
                EXPECT_EQ(flat.vertices.row(v), part.vertices.row(flat.original[v]));
            }
    }
    EXPECT_EQ(faces, std::multiset<Index>(part.faces.begin(), part.faces.end()));
    EXPECT_LT(after, 0.5 * energy(part));
}

TEST(RoomyCuts, a_long_strip_is_cut_across_and_its_pieces_keep_their_map)
{
    const FlatPart part = strip_part(96, 6);
    const ThroughPrice price{5e-4, 2.5e-5};
    const std::vector<HeldPart> parts = cut_for_room(part, price);
    ASSERT_GT(parts.size(), 2U);
    EXPECT_GT(packed_scale(parts), 2.0 * packed_scale({{part, {}}}));
    std::multiset<Index> faces;
    for (const HeldPart& held : parts) {
        const FlatPart& flat = held.flat;
        faces.insert(flat.faces.begin(), flat.faces.end());
        EXPECT_TRUE(lies_one_to_one(flat, flat.points));
        for (Index v = 0; v < flat.surface.vertex_count; ++v)
            EXPECT_EQ(flat.points.row(v), part.points.row(flat.original[v]));
    }
    EXPECT_EQ(faces, std::multiset<Index>(part.faces.begin(), part.faces.end()));
}

TEST(RoomyCuts, neither_a_square_nor_a_part_with_dear_cuts_is_cut)
{
    EXPECT_EQ(cut_for_room(strip_part(12, 12), {5e-6, 2.5e-7}).size(), 1U);
    EXPECT_EQ(cut_for_room(strip_part(96, 6), {1.0, 0.05}).size(), 1U);
    FlatPart held = strip_part(96, 6);
    std::vector<HeldPart> parts{{held, {RoundLoop{}}}};
    ExecutionContext context;
    EXPECT_FALSE(cut_parts_for_room(parts, {5e-4, 2.5e-5}, 1, context));
}

TEST(RoomyCuts, a_strip_and_its_mirror_image_are_cut_alike)
{
    FlatPart one = strip_part(96, 6), other = one;
    other.points.col(0) *= -1.0;
    other.vertices.col(0) *= -1.0;
    for (auto face : other.surface.triangles.rowwise()) std::swap(face[1], face[2]);
    const Index count = one.surface.vertex_count;
    other.surface = require_bordered_genus_zero(other.surface.triangles, count);
    for (Index v = 0; v < count; ++v) {
        other.original[v] = v + count;
        one.image.push_back(v + count);
        other.image.push_back(v);
    }
    for (Index& f : other.faces) f += static_cast<Index>(one.faces.size());
    std::vector<HeldPart> parts{{one, {}}, {other, {}}};
    ExecutionContext context;
    ASSERT_TRUE(cut_parts_for_room(parts, {5e-4, 2.5e-5}, 1, context));
    std::multiset<std::set<Index>> sides[2];
    for (const HeldPart& part : parts) {
        const bool is_image = part.flat.faces.front() >= static_cast<Index>(one.faces.size());
        std::set<Index> own;
        for (const Index f : part.flat.faces) own.insert(is_image ? f - static_cast<Index>(one.faces.size()) : f);
        sides[is_image].insert(own);
    }
    EXPECT_GT(sides[0].size(), 1U);
    EXPECT_EQ(sides[0], sides[1]);
}
