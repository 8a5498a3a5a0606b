#include "even/even_forces.h"
#include "parts/through_rounds.h"

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
    FlatPart part;
    const auto at = [&](int i, int j) { return static_cast<Index>(j * around + i % around); };
    part.vertices.resize(around * (rows + 1), 3);
    part.points.resize(part.vertices.rows(), 2);
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i < around; ++i) {
            const double angle = 2.0 * pi * i / around, height = j / double(rows), r = radius(height);
            part.vertices.row(at(i, j)) << r * std::cos(angle), r * std::sin(angle), height;
            const Complex z = std::polar(0.2 + 0.4 * height, -angle);
            part.points.row(at(i, j)) << z.real(), z.imag();
        }
    Triangles triangles(2 * around * rows, 3);
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < around; ++i) {
            triangles.row(2 * (j * around + i)) << at(i, j), at(i + 1, j + 1), at(i + 1, j);
            triangles.row(2 * (j * around + i) + 1) << at(i, j), at(i, j + 1), at(i + 1, j + 1);
        }
    part.surface = require_bordered_genus_zero(triangles, static_cast<Index>(part.vertices.rows()));
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f) part.faces.push_back(f);
    for (Index v = 0; v < part.surface.vertex_count; ++v) part.original.push_back(v);
    part.held.assign(part.original.size(), 0);
    part.vertices /= std::sqrt(face_areas(part.vertices, part.surface.triangles).sum());
    return part;
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
    const FlatPart& open = parts[0].flat;
    EXPECT_EQ(open.surface.loops.size(), 1U);
    EXPECT_EQ(open.faces, part.faces);
    EXPECT_GE(open.slit, 1.0 / std::sqrt(pi) - 1e-3);  // its height, of area 1,
    EXPECT_LE(open.slit, 1.1 / std::sqrt(pi));         // along edges
    EXPECT_LT(energy(open), 1e-3 * before);
    EXPECT_TRUE(lies_one_to_one(open, open.points));
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

TEST(ThroughCuts, pieces_are_the_part_and_without_a_price_of_pieces_nothing_is_split)
{
    FlatPart part = ring_part(24, 24, [](double h) { return 0.3 + 0.25 * std::sin(2.0 * pi * h); });
    relax(part);
    EXPECT_EQ(cut(part, {1e-5, {}}).size(), 1U);
    EXPECT_FALSE(promising_through_cuts(part, even, {1e-5, 1e-5}).empty());
    for (const ThroughPrice& price : {ThroughPrice{1e-5, {}}, ThroughPrice{1e-5, 1e-5}})
        for (const ThroughCut& promising : promising_through_cuts(part, even, price))
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
