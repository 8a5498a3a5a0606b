#include "circles/circle_fit.h"
#include "circles/circle_projection.h"
#include "circles/crowded_circles.h"
#include "embedding/embedded_map.h"
#include "planar/boundary_crossings.h"
#include "quality/stored_uv.h"
#include "random_disks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

using namespace koebe;
using namespace koebe::test;

namespace {

/// Takes some faces that have no vertex in common out of a disk, none at its loop (vertices 0 to `outer`).
FaceList with_holes(FaceList faces, Index outer, std::size_t count, std::mt19937& random)
{
    std::shuffle(faces.begin(), faces.end(), random);
    std::set<Index> taken;
    for (Index v = 0; v < outer; ++v) taken.insert(v);
    std::erase_if(faces, [&](const auto& face) {
        if (count == 0) return false;
        if (std::any_of(face.begin(), face.end(), [&](Index v) { return taken.contains(v); })) return false;
        taken.insert(face.begin(), face.end());
        --count;
        return true;
    });
    return faces;
}

Vertices random_positions(Index count, std::mt19937& random)
{
    Vertices vertices(count, 3);
    std::normal_distribution<double> normal;
    for (Eigen::Index i = 0; i < vertices.size(); ++i) vertices.data()[i] = normal(random);
    return vertices;
}

/// All faces upright, as stored too, no loop crossing another, the outer one once round the unit circle.
void expect_upright(const Surface& surface, const PlanarPoints& points)
{
    EXPECT_TRUE(points.allFinite());
    EXPECT_TRUE(crossing_boundary_edges(surface.loops, points, 2.0 * uv_resolution).empty());
    const VectorXcd z = points.col(0) + Complex(0.0, 1.0) * points.col(1), rim = gather_loop(z, surface.loops[0]);
    EXPECT_TRUE(run_once_round(rim, 1));
    EXPECT_LT((rim.cwiseAbs().array() - 1.0).abs().maxCoeff(), 1e-9);
    int folded = 0, lost = 0;
    for (Eigen::Index f = 0; f < surface.triangles.rows(); ++f) {
        const Complex a = z[surface.triangles(f, 0)], u = z[surface.triangles(f, 1)] - a,
                      v = z[surface.triangles(f, 2)] - a;
        folded += !(std::imag(std::conj(u) * v) > 0.0);
        const StoredFace stored(surface.triangles, points, f);
        lost += stored.flipped() && !stored.below_resolution();
    }
    EXPECT_EQ(folded, 0);
    EXPECT_EQ(lost, 0) << "as stored";
}

/// Maps a surface, and checks what is promised of every face, loop and circle; without circles likewise.
CircleMap expect_one_to_one(const FaceList& faces, const Vertices& vertices, const std::vector<Circle>& wanted,
                            bool crowded_rim = false)
{
    const Triangles triangles = as_triangles(faces);
    const Surface surface = require_bordered_genus_zero(triangles, triangles.maxCoeff() + 1);
    const VertexLoop& outer = surface.loops[0];
    VectorXcd rim(outer.size());
    for (std::size_t i = 0; i < outer.size(); ++i)
        rim[i] = std::polar(1.0, (crowded_rim ? 2e-3 : 2.0 * std::numbers::pi / outer.size()) * static_cast<double>(i));
    const CircleMap map = embedded_map(vertices, surface, surface.loops, {}, wanted, rim, {});

    expect_upright(surface, map.uv);
    expect_upright(surface, freely_embedded(vertices, surface, surface.loops, {}));
    EXPECT_TRUE(circles_apart(map.circles));
    int off = 0;
    for (std::size_t k = 0; k < surface.loops.size(); ++k)
        for (const Index v : surface.loops[k]) {
            const double distance = std::abs(Complex(map.uv(v, 0), map.uv(v, 1)) - map.circles[k].center);
            const bool listed = std::binary_search(map.off_circle.begin(), map.off_circle.end(), v);
            off += std::abs(distance - map.circles[k].radius) > 1e-6 && !listed;
        }
    EXPECT_EQ(off, 0) << "off their circles, and not listed";
    return map;
}

}  // namespace

TEST(EmbeddedMap, is_one_to_one_and_round_on_its_own_circles)
{
    std::mt19937 random(1);
    std::size_t off = 0, on = 0;
    for (int i = 0; i < 12; ++i) {
        const FaceList disk = i % 3 == 0   ? stacked_disk(150, 0, random)
                              : i % 3 == 1 ? limb(30, 6)
                                           : stacked_disk(60, 2, random);
        const FaceList faces = with_holes(flipped_at_random(disk, 500, random), i % 3 == 1 ? 6 : 3, 1 + i / 2, random);
        const CircleMap map = expect_one_to_one(faces, random_positions(200, random), {});
        off += map.off_circle.size();
        on += 3 * (map.circles.size() - 1);
    }
    EXPECT_LT(off, on / 20);
}

TEST(EmbeddedMap, wanted_circles_that_cannot_be_reached_cost_no_face)
{
    std::mt19937 random(2);
    for (int i = 0; i < 8; ++i) {
        const FaceList faces = with_holes(flipped_at_random(stacked_disk(100, 0, random), 500, random), 3, 3, random);
        // Tiny ones side by side, at the rim; then ones as large as there is room for.
        std::vector<Circle> wanted{Circle{}};
        const std::size_t loops = require_bordered_genus_zero(as_triangles(faces), 103).loops.size();
        for (std::size_t k = 1; k < loops; ++k)
            wanted.push_back(i % 2 == 0 ? Circle{{0.999, 1e-5 * static_cast<double>(k)}, 1e-11}
                                        : Circle{std::polar(0.5, 2.0 * static_cast<double>(k)), 0.4});
        expect_one_to_one(faces, random_positions(103, random), wanted);
    }
}

TEST(EmbeddedMap, a_rim_without_room_is_given_some)
{
    std::mt19937 random(3);
    for (int i = 0; i < 6; ++i)
        expect_one_to_one(with_holes(flipped_at_random(limb(20, 5), 100, random), 5, i, random),
                          random_positions(101, random), {}, true);
}

TEST(EmbeddedMap, circles_within_reach_are_kept)
{
    FaceList faces = limb(12, 12);
    std::erase_if(faces, [](const auto& face) { return face[2] == 144; });
    Vertices rings = Vertices::Zero(144, 3);
    for (Index v = 0; v < 144; ++v) {
        const Complex place = std::polar(1.0 - (v / 12) / 15.0, std::numbers::pi / 6.0 * (v % 12));
        rings.row(v) << place.real(), place.imag(), 0.0;
    }
    const std::vector<Circle> wanted{Circle{}, {{0.2, 0.1}, 0.3}};
    const CircleMap map = expect_one_to_one(faces, rings, wanted);
    EXPECT_EQ(map.circles[1].center, wanted[1].center);
    EXPECT_EQ(map.circles[1].radius, wanted[1].radius);
    EXPECT_TRUE(map.off_circle.empty());
}

TEST(EmbeddedMap, a_map_wrong_in_few_faces_is_mended_there)
{
    // A flat disk of rings round a hole, and some vertices that are pushed over their neighbours.
    constexpr Index around = 60, rings = 40;
    FaceList faces;
    Vertices vertices(around * rings, 3);
    for (Index i = 0; i < rings; ++i)
        for (Index j = 0; j < around; ++j) {
            const Complex z = std::polar(1.0 - 0.9 * i / (rings - 1), 2.0 * std::numbers::pi * j / around);
            vertices.row(i * around + j) << z.real(), z.imag(), 0.0;
            if (i + 1 == rings) continue;
            const Index a = i * around + j, b = i * around + (j + 1) % around;
            faces.push_back({a, b, a + around});
            faces.push_back({b, b + around, a + around});
        }
    const Triangles triangles = as_triangles(faces);
    const Surface surface = require_bordered_genus_zero(triangles, around * rings);
    CircleMap map;
    map.circles = {Circle{}, Circle{0.0, 0.1}};
    map.uv = vertices.leftCols(2);
    const PlanarPoints given = map.uv;
    for (const Index v : {(rings - 1) * around, (rings - 2) * around + 1, 5 * around + 7})
        map.uv.row(v) += Eigen::RowVector2d(0.05, 0.08);
    const std::optional<CircleMap> mended = mended_map(vertices, surface, surface.loops, {}, map, {});
    ASSERT_TRUE(mended);
    expect_upright(surface, mended->uv);
    EXPECT_TRUE(mended->off_circle.empty());
    Index moved = 0;
    for (Index v = 0; v < around * rings; ++v) moved += mended->uv.row(v) != given.row(v);
    EXPECT_LT(moved, around * rings / 3) << "the rest stays to the bit";
    // A map that is wrong in many faces is left to embedded_map.
    map.uv.col(1) = -map.uv.col(1);
    EXPECT_FALSE(mended_map(vertices, surface, surface.loops, {}, map, {}));
}
