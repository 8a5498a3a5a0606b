#include "core/connectivity.h"
#include "mesh/topology.h"
#include "parts/pinholes.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace koebe;

namespace {

constexpr Index side = 40;  // cells of a plate of area 1

Index corner(Index column, Index row) { return row * (side + 1) + column; }

/// A plate with holes of one cell and of 6 by 6 cells, none or all of its boundary at cuts.
PieceInput plate(bool at_cut)
{
    Vertices vertices = Vertices::Zero((side + 1) * (side + 1), 3);
    for (Index row = 0; row <= side; ++row)
        for (Index column = 0; column <= side; ++column)
            vertices.row(corner(column, row)) << static_cast<double>(column) / side, static_cast<double>(row) / side,
                0.0;
    std::vector<std::array<Index, 3>> faces;
    for (Index row = 0; row < side; ++row)
        for (Index column = 0; column < side; ++column) {
            const bool in_wide = column >= 25 && column < 31 && row >= 5 && row < 11;
            if (in_wide || (column == 10 && row == 20)) continue;
            const Index a = corner(column, row), b = corner(column + 1, row);
            faces.push_back({a, b, b + side + 1});
            faces.push_back({a, b + side + 1, a + side + 1});
        }
    Triangles triangles(static_cast<Eigen::Index>(faces.size()), 3);
    std::vector<Index> number(static_cast<std::size_t>(vertices.rows()), -1), kept;
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            Index& own = number[faces[f][k]];
            if (own < 0) {
                own = static_cast<Index>(kept.size());
                kept.push_back(faces[f][k]);
            }
            triangles(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(k)) = own;
        }
    PieceInput input{whole_piece(vertices(kept, Eigen::all), triangles)};
    if (at_cut) input.seam.assign(static_cast<std::size_t>(triangles.size()), 1);
    return input;
}

Surface surface_of_piece(const PieceInput& input)
{
    return require_bordered_genus_zero(input.piece.triangles, static_cast<Index>(input.piece.vertices.rows()));
}

/// The plate in its own place, with some of its faces.
FlatPart flat_part_of(const PieceInput& input, const std::vector<char>& taken)
{
    FlatPart part;
    for (std::size_t f = 0; f < taken.size(); ++f)
        if (taken[f]) part.faces.push_back(static_cast<Index>(f));
    part.vertices = input.piece.vertices;
    part.points = part.vertices.leftCols(2);
    std::vector<Index> number(static_cast<std::size_t>(part.vertices.rows()), -1);
    Triangles triangles = input.piece.triangles(part.faces, Eigen::all);
    for (Index& v : triangles.reshaped()) {
        if (number[v] < 0) {
            number[v] = static_cast<Index>(part.original.size());
            part.original.push_back(v);
        }
        v = number[v];
    }
    part.vertices = Vertices(part.vertices(part.original, Eigen::all));
    part.points = PlanarPoints(part.points(part.original, Eigen::all));
    part.surface = require_bordered_genus_zero(triangles, static_cast<Index>(part.original.size()));
    part.held.assign(part.original.size(), 0);
    return part;
}

}  // namespace

TEST(Pinholes, a_small_hole_is_filled_and_a_wide_one_is_not)
{
    const PieceInput input = plate(false);
    const auto filled = without_pinholes(input, surface_of_piece(input));
    ASSERT_TRUE(filled.has_value());
    EXPECT_EQ(filled->piece.triangles.rows(), input.piece.triangles.rows() + 4);
    EXPECT_EQ(filled->piece.source_face.back(), -1);
    const Surface surface = surface_of_piece(*filled);
    EXPECT_EQ(surface.loops.size(), 2u);
    EXPECT_EQ(surface.triangles, filled->piece.triangles) << "the faces that fill have the orientation of the others";
    EXPECT_NEAR(face_areas(filled->piece.vertices, surface.triangles).sum(), 1.0 - 36.0 / (side * side), 1e-12);
}

TEST(Pinholes, a_loop_at_a_cut_stays_open)
{
    const PieceInput input = plate(true);
    EXPECT_FALSE(without_pinholes(input, surface_of_piece(input)).has_value());
}

TEST(Pinholes, a_part_gets_its_holes_back_in_its_place)
{
    const PieceInput input = plate(false);
    const auto filled = without_pinholes(input, surface_of_piece(input));
    const FlatPart part =
        flat_part_of(*filled, std::vector<char>(static_cast<std::size_t>(filled->piece.triangles.rows()), 1));
    const auto count = static_cast<Index>(input.piece.triangles.rows());
    const std::vector<FlatPart> open = with_pinholes(part, count);
    ASSERT_EQ(open.size(), 1u);
    EXPECT_EQ(open[0].surface.loops.size(), 3u);
    EXPECT_EQ(static_cast<Index>(open[0].faces.size()), count);
    for (std::size_t v = 0; v < open[0].original.size(); ++v)
        EXPECT_EQ(open[0].points.row(static_cast<Index>(v)),
                  filled->piece.vertices.row(open[0].original[v]).leftCols(2));
}

TEST(Pinholes, corners_that_met_across_a_pinhole_are_drawn_apart)
{
    const PieceInput input = plate(false);
    const auto filled = without_pinholes(input, surface_of_piece(input));
    const Surface surface = surface_of_piece(*filled);
    const auto count = static_cast<Index>(input.piece.triangles.rows());
    // The part's boundary runs through a corner of the hole: of the faces there, only those beside the hole stay.
    const Index at = filled->piece.triangles(count, 0);
    std::vector<char> taken(surface.triangles.rows(), 1), beside(taken.size(), 0);
    for (Index h = 3 * count; h < static_cast<Index>(surface.twin.size()); ++h)
        if (surface.twin[h] != no_twin) beside[face_of(surface.twin[h])] = 1;
    for (Index f = 0; f < count; ++f)
        if (!beside[f] && (surface.triangles.row(f).array() == at).any()) taken[f] = 0;
    const FlatPart part = flat_part_of(*filled, taken);
    const std::vector<FlatPart> open = with_pinholes(part, count);
    ASSERT_EQ(open.size(), 1u);
    EXPECT_EQ(std::ranges::count(open[0].original, at), 2);
    EXPECT_TRUE(lies_one_to_one(open[0], open[0].points));
}
