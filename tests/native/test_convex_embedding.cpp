#include "embedding/convex_embedding.h"
#include "quality/stored_uv.h"
#include "random_disks.h"

#include <gtest/gtest.h>

#include <numbers>

using namespace koebe;
using namespace koebe::test;

namespace {

/// Embeds a disk with its loop evenly on the circle, and checks what is promised of every triangle and outer vertex.
PlanarPoints expect_embedded(const FaceList& faces)
{
    const Triangles triangles = as_triangles(faces);
    const Surface surface = require_bordered_genus_zero(triangles, triangles.maxCoeff() + 1);
    const FilledDisk filled = fill_with_fans(surface, surface.loops);
    const VertexLoop& outer = surface.loops[0];
    const double step = 2.0 * std::numbers::pi / static_cast<double>(outer.size());
    VectorXcd rim(outer.size());
    for (std::size_t i = 0; i < outer.size(); ++i) rim[i] = std::polar(1.0, step * static_cast<double>(i));
    const PlanarPoints points = convex_embedding(filled, outer, rim, {});

    Eigen::Index folded = 0, lost = 0;
    double least = 1.0;
    for (Eigen::Index f = 0; f < filled.triangles.rows(); ++f) {
        const Eigen::RowVector2d a = points.row(filled.triangles(f, 0)), u = points.row(filled.triangles(f, 1)) - a,
                                 v = points.row(filled.triangles(f, 2)) - a;
        const double height = (u[0] * v[1] - u[1] * v[0]) / std::max({u.norm(), v.norm(), (u - v).norm()});
        least = std::min(least, height);
        folded += !(height > 0.0);
        lost += StoredFace(filled.triangles, points, f).flipped();
    }
    EXPECT_EQ(folded, 0);
    EXPECT_EQ(lost, 0) << "as stored";
    EXPECT_GT(least, 1e-7) << "the least height of a face";
    for (std::size_t i = 0; i < outer.size(); ++i) EXPECT_EQ(Complex(points(outer[i], 0), points(outer[i], 1)), rim[i]);
    return points;
}

}  // namespace

TEST(ConvexEmbedding, triangles_stacked_a_thousand_deep_are_all_upright)
{
    std::mt19937 random(1);
    expect_embedded(stacked_disk(1000, 1, random));
    expect_embedded(stacked_disk(1000, 3, random));
}

TEST(ConvexEmbedding, random_stacked_triangles_are_all_upright)
{
    std::mt19937 random(2);
    for (int i = 0; i < 20; ++i) expect_embedded(stacked_disk(40 + 40 * i, 0, random));
}

TEST(ConvexEmbedding, a_limb_is_drawn_to_its_end)
{
    expect_embedded(limb(1000, 6));
    expect_embedded(limb(1000, 3));
    expect_embedded(limb(300, 40));
}

TEST(ConvexEmbedding, random_triangulations_are_all_upright)
{
    std::mt19937 random(3);
    for (int i = 0; i < 10; ++i) {
        expect_embedded(flipped_at_random(stacked_disk(60 * i + 10, 0, random), 3000, random));
        expect_embedded(flipped_at_random(stacked_disk(60 * i + 10, 1, random), 30 * i, random));
        expect_embedded(flipped_at_random(limb(20 * i + 5, 5), 100 * i, random));
    }
}

TEST(ConvexEmbedding, a_surface_full_of_holes_is_all_upright)
{
    std::mt19937 random(4);
    FaceList faces = flipped_at_random(limb(60, 12), 2000, random);
    // A face is a hole of three vertices where no other hole is near.
    std::vector<char> taken(12 * 60 + 1, 0);
    for (Index v = 0; v < 12; ++v) taken[v] = 1;
    std::erase_if(faces, [&](const auto& face) {
        for (const Index v : face)
            if (taken[v]) return false;
        for (const Index v : face) taken[v] = 1;
        return true;
    });
    expect_embedded(faces);
}

TEST(ConvexEmbedding, where_equal_weights_do_every_inner_vertex_is_the_mean_of_its_neighbours)
{
    const PlanarPoints points = expect_embedded(limb(3, 8));
    for (Index v = 8; v < 16; ++v) {
        const Index next = v % 8 == 7 ? v - 7 : v + 1, previous = v % 8 == 0 ? v + 7 : v - 1;
        const Index in = v + 8, out = v - 8, in_next = next + 8, out_previous = previous - 8;
        const Eigen::RowVector2d mean = (points.row(next) + points.row(previous) + points.row(in) + points.row(out) +
                                         points.row(in_next) + points.row(out_previous)) /
                                        6.0;
        EXPECT_LT((points.row(v) - mean).norm(), 1e-14);
    }
}
