#include "core/connectivity.h"
#include "darts/stitches.h"
#include "darts/tension.h"
#include "darts/through_cuts.h"
#include "even/even_map.h"
#include "flat/part_borders.h"
#include "grids.h"
#include "planar/rigid_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace koebe;

namespace {

constexpr double even = 0.1;
constexpr int squares = 12;  // along each side

Index at(int i, int j) { return static_cast<Index>(j * (squares + 1) + i); }

/// A square of area 1 with a hill in its middle, seen from above. @param height of the hill, over the side
FlatPart hill(double height)
{
    FlatPart part = test::part_of(test::grid(squares, squares, at));
    part.vertices.resize((squares + 1) * (squares + 1), 3);
    for (int j = 0; j <= squares; ++j)
        for (int i = 0; i <= squares; ++i) {
            const double x = i / double(squares), y = j / double(squares);
            const double wave = std::sin(std::numbers::pi * x) * std::sin(std::numbers::pi * y);
            part.vertices.row(at(i, j)) << x, y, height * wave * wave;
        }
    part.vertices /= std::sqrt(face_areas(part.vertices, part.surface.triangles).sum());
    part.points = part.vertices.leftCols<2>();
    return part;
}

void relax(FlatPart& part)
{
    std::vector<RoundLoop> none;
    ExecutionContext context;
    make_even(flat_surface(part, none), even, packed_side, context);
}

/// The hill in two halves, each relaxed. The second one lies elsewhere, turned.
std::vector<HeldPart> halves(double height)
{
    const FlatPart whole = hill(height);
    ThroughCut cut;
    for (int j = 0; j <= squares; ++j) {
        cut.vertices.push_back(at(squares / 2, j));
        if (j == 0) continue;
        const Triangles& triangles = whole.surface.triangles;
        for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h)
            if (origin(triangles, h) == at(squares / 2, j - 1) && target(triangles, h) == at(squares / 2, j))
                cut.halfedges.push_back(h);
    }
    std::vector<HeldPart> parts;
    for (FlatPart& part : cut_through(whole, cut)) {
        relax(part);
        parts.push_back({std::move(part), {}});
    }
    PlanarPoints& moved = parts.back().flat.points;
    const PlanarPoints before = moved;
    moved.col(0) = 3.0 - before.col(1).array();
    moved.col(1) = before.col(0).array() - 2.0;
    return parts;
}

/// The hill in one piece, cut open from below to `length` squares, and relaxed.
FlatPart slit_hill(double height, int length)
{
    const FlatPart whole = hill(height);
    Triangles triangles = whole.surface.triangles;
    std::vector<Index> source(whole.original);
    // The faces on the right of the slit get copies of its vertices, but for the last one.
    for (int j = 0; j < length; ++j) source.push_back(at(squares / 2, j));
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        double x = 0.0;
        for (const Index v : triangles.row(f)) x += whole.vertices(v, 0) / 3.0;
        if (x < whole.vertices(at(squares / 2, 0), 0)) continue;
        for (Index& v : triangles.row(f))
            for (int j = 0; j < length; ++j)
                if (v == at(squares / 2, j)) v = static_cast<Index>(whole.original.size()) + j;
    }
    FlatPart part = opened_piece(whole, whole.faces, triangles, source).value();
    part.tips = {at(squares / 2, length)};
    part.dart_length = static_cast<double>(length) / squares;
    relax(part);
    return part;
}

double energy_of(const std::vector<HeldPart>& parts)
{
    double sum = 0.0;
    for (const HeldPart& part : parts) sum += forces_in(part.flat, even).energy.sum();
    return sum;
}

TEST(Stitches, two_halves_become_one_where_it_costs_less_than_the_cut)
{
    for (const double height : {0.1, 0.3}) {
        std::vector<HeldPart> parts = halves(height);
        ASSERT_EQ(parts.size(), 2u);
        const double apart = energy_of(parts);
        ExecutionContext context;
        EXPECT_TRUE(stitch_parts(parts, even, {0.2, {}}, context));
        ASSERT_EQ(parts.size(), 1u);
        const FlatPart& joined = parts.front().flat;
        EXPECT_TRUE(lies_one_to_one(joined, joined.points));
        EXPECT_EQ(joined.faces.size(), static_cast<std::size_t>(2 * squares * squares));
        EXPECT_TRUE(std::ranges::is_sorted(joined.faces));
        EXPECT_EQ(joined.surface.loops.size(), 1u);
        EXPECT_LT(energy_of(parts) - apart, 0.2);
        // Each vertex stands where the whole has it.
        const FlatPart whole = hill(height);
        for (std::size_t v = 0; v < joined.original.size(); ++v)
            EXPECT_LT((joined.vertices.row(static_cast<Index>(v)) - whole.vertices.row(joined.original[v])).norm(),
                      1e-12);
    }
}

TEST(Stitches, a_slit_closes_where_it_costs_less_than_the_cut)
{
    std::vector<HeldPart> parts{{slit_hill(0.3, squares / 2), {}}};
    ASSERT_GT(parts.front().flat.surface.vertex_count, static_cast<Index>((squares + 1) * (squares + 1)));
    ExecutionContext context;
    EXPECT_TRUE(stitch_parts(parts, even, {0.2, {}}, context));
    ASSERT_EQ(parts.size(), 1u);
    const FlatPart& closed = parts.front().flat;
    EXPECT_EQ(closed.surface.vertex_count, static_cast<Index>((squares + 1) * (squares + 1)));
    EXPECT_EQ(closed.surface.loops.size(), 1u);
    EXPECT_LT(closed.dart_length, 1e-12);
    EXPECT_TRUE(closed.tips.empty());
    EXPECT_TRUE(lies_one_to_one(closed, closed.points));

    // At a low price most of it stays where the hill needs it.
    std::vector<HeldPart> steep{{slit_hill(1.5, squares / 2), {}}};
    stitch_parts(steep, even, {1e-4, {}}, context);
    const FlatPart& open = steep.front().flat;
    EXPECT_GT(open.surface.vertex_count, closed.surface.vertex_count + squares / 4);
    EXPECT_EQ(open.tips.size(), 1u);
    EXPECT_TRUE(lies_one_to_one(open, open.points));
}

TEST(Stitches, a_cut_that_is_cheap_stays_where_the_surface_is_bent)
{
    std::vector<HeldPart> parts = halves(1.5);
    const std::vector<HeldPart> before = parts;
    ExecutionContext context;
    EXPECT_FALSE(stitch_parts(parts, even, {1e-4, {}}, context));
    ASSERT_EQ(parts.size(), 2u);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(parts[k].flat.points, before[k].flat.points);
}

TEST(Stitches, flat_parts_stay)
{
    std::vector<HeldPart> parts = halves(0.0);
    ExecutionContext context;
    EXPECT_FALSE(stitch_parts(parts, even, {1.0, 1.0}, context));
    EXPECT_EQ(parts.size(), 2u);
}

TEST(PartBorders, the_border_of_two_halves_is_one_run_of_edges)
{
    std::vector<FlatPart> parts;
    for (HeldPart& part : halves(0.2)) parts.push_back(std::move(part.flat));
    const PartBorders borders(parts);
    ASSERT_EQ(borders.all().size(), 1u);
    const PartBorder& border = borders.all().front();
    ASSERT_EQ(border.edges(), static_cast<std::size_t>(squares));
    EXPECT_FALSE(border.is_ring);
    std::vector<Index> names;
    for (std::size_t i = 0; i <= border.edges(); ++i) {
        const auto [v, w] = borders.vertices_at(border, i);
        EXPECT_EQ(parts[border.first].original[v], parts[border.second].original[w]);
        names.push_back(parts[border.first].original[v]);
    }
    if (names.front() != at(squares / 2, 0)) std::ranges::reverse(names);
    for (int j = 0; j <= squares; ++j) EXPECT_EQ(names[j], at(squares / 2, j));
}

TEST(PartBorders, a_slit_is_a_border_of_a_part_with_itself)
{
    constexpr int length = 5;
    const std::vector<FlatPart> parts{slit_hill(0.2, length)};
    const PartBorders borders(parts);
    ASSERT_EQ(borders.all().size(), 1u);
    const PartBorder& border = borders.all().front();
    EXPECT_EQ(border.first, border.second);
    ASSERT_EQ(border.edges(), static_cast<std::size_t>(length));
    EXPECT_FALSE(border.is_ring);
    for (std::size_t i = 0; i < border.edges(); ++i)
        EXPECT_EQ(borders.name({0, border.of_first[i]}), borders.name({0, border.of_second[i]}));
}

TEST(RigidFit, it_finds_a_turn_and_a_shift_and_what_is_left)
{
    const Complex turn = std::polar(1.0, 0.7), shift(3.0, -2.0);
    const std::vector<Complex> places{{0.0, 0.0}, {1.0, 0.5}, {-0.3, 2.0}, {0.4, -1.1}};
    RigidFit fit, all;
    for (const Complex z : places) fit.add(turn * z + shift, z, 2.0);
    all.add({5.0, 5.0}, {1.0, 1.0});
    RigidFit more = all;
    for (const Complex z : places) more.add(turn * z + shift, z, 2.0);
    for (const RigidFit& own : {fit, more - all}) {
        EXPECT_LT(std::abs(own.turn() - turn), 1e-12);
        EXPECT_LT(own.misfit(), 1e-12);
        EXPECT_LT(std::abs(own.moved({0.2, 0.3}) - (turn * Complex(0.2, 0.3) + shift)), 1e-12);
    }
    EXPECT_GT(fit.distance(), 1.0);
    RigidFit apart;
    for (const Complex z : places) apart.add(z + Complex(0.3, 0.4), z);
    EXPECT_NEAR(apart.distance(), 0.25, 1e-12);
    // Two pairs, one unit longer on one side: half a unit is left at either end.
    RigidFit longer;
    longer.add({0.0, 0.0}, {0.0, 0.0});
    longer.add({2.0, 0.0}, {1.0, 0.0});
    EXPECT_NEAR(longer.misfit(), 0.25, 1e-12);
}

}  // namespace
