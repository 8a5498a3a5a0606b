#include "grids.h"
#include "part_maps/part_map.h"
#include "part_maps/part_mesh.h"
#include "parts/pack_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

using namespace koebe;

namespace {

/// A flat strip whose map winds round the origin by that angle. Above a full turn it overlaps itself.
FlatPart strip(double angle)
{
    constexpr Index length = 60, across = 4;
    const auto at = [](Index k, Index i) { return i * (across + 1) + k; };
    FlatPart part = test::part_of(test::grid(across, length, at));
    part.vertices.resize(part.surface.vertex_count, 3);
    part.points.resize(part.surface.vertex_count, 2);
    for (Index i = 0; i <= length; ++i)
        for (Index k = 0; k <= across; ++k) {
            const double turn = angle * i / length, r = 0.5 + 0.1 * k;
            part.vertices.row(at(k, i)) << 0.5 * turn, -0.1 * k, 0.0;
            part.points.row(at(k, i)) << r * std::cos(turn), r * std::sin(turn);
        }
    return part;
}

}  // namespace

TEST(PackParts, a_part_that_overlaps_itself_is_drawn_anew_and_says_so)
{
    for (const double turns : {0.9, 1.2}) {
        std::vector<FlatPart> flats = {strip(2.0 * std::numbers::pi * turns)};
        ExecutionContext context;
        const PackedParts packed = pack_parts(flats, {.threads = 1}, context);
        EXPECT_EQ(packed.anew[0] != 0, turns > 1.0);
        EXPECT_TRUE(flats[0].one_to_one);
        EXPECT_TRUE(loops_apart(flats[0], packed.places[0]));
    }
}

TEST(FlatPart, a_part_whose_map_is_not_finite_is_drawn_anew_and_is_one_to_one)
{
    const FlatPart flat = strip(1.0);
    const CutSurface whole = cut_surface(flat.vertices, flat.surface.triangles, {});
    ExecutionContext context;
    Part part{part_mesh(whole, flat.faces), {}};
    part.map = map_part(part.mesh, MapPurpose::result, context);
    part.map.positions[7] = std::numeric_limits<double>::quiet_NaN();
    for (const VertexLoop& loop : part.mesh.surface.loops)
        for (const Index v : loop) part.map.positions[v] = part.map.positions[7];
    const FlatPart anew = flat_part(part, {}, context);
    EXPECT_EQ(anew.faces, flat.faces);
    EXPECT_TRUE(lies_one_to_one(anew, anew.points));
}
