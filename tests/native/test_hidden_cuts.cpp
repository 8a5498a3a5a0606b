#include "cut_samples.h"
#include "mesh/topology.h"
#include "splitting/concavity.h"
#include "splitting/dual_cut.h"
#include "splitting/hidden_cuts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

using namespace koebe;
using namespace koebe::test;

namespace {

/// A body whose radius falls from 1 to 0.8 along a groove at height 0.
Mesh grooved(double groove)
{
    std::vector<std::pair<double, double>> profile;
    for (int k = -40; k <= 40; ++k) {
        const double h = 0.05 * k;
        profile.emplace_back(1.0 - groove * std::exp(-h * h / 0.02), h);
    }
    return revolved(profile, 64);
}

}  // namespace

TEST(Concavity, is_that_of_spheres_and_grooves_whichever_way_the_faces_look)
{
    std::vector<std::pair<double, double>> profile{{0.0, -1.0}};
    for (int k = 1; k < 40; ++k) profile.emplace_back(std::sin(pi * k / 40), -std::cos(pi * k / 40));
    profile.emplace_back(0.0, 1.0);
    const Mesh sphere = revolved(profile, 80);
    for (const double radius : {0.5, 1.0, 3.0}) {
        const Vertices points = radius * sphere.vertices;
        const CutSurface whole =
            cut_surface(points, analyze_surface(sphere.triangles, static_cast<Index>(points.rows())), {});
        const VectorXd curvature = mean_curvature(whole, 0.1 * radius);
        EXPECT_NEAR(curvature.mean(), 1.0 / radius, 0.02 / radius);
    }
    Mesh mesh = grooved(0.2);
    for (int side = 0; side < 2; ++side) {
        const CutSurface whole = cut_surface(mesh.vertices, mesh.triangles, {});
        const VectorXd curvature = mean_curvature(whole, 0.05);
        for (Eigen::Index v = 0; v < curvature.size(); ++v) {
            const double h = std::abs(mesh.vertices(v, 2));
            if (h < 0.04) {
                EXPECT_LT(curvature[v], -0.5) << v;
            } else if (h > 0.8 && h < 1.7) {
                EXPECT_NEAR(curvature[v], 0.5, 0.1) << v;
            }
        }
        mesh.triangles.col(1).swap(mesh.triangles.col(2));
    }
}

TEST(HiddenCuts, go_into_a_groove_nearby_and_nowhere_without_one)
{
    for (const double groove : {0.1, 0.0}) {
        const Mesh mesh = grooved(groove);
        const CutSurface whole = cut_surface(mesh.vertices / 5.0, mesh.triangles, {});
        std::vector<std::vector<Index>> faces(2);
        for (Index f = 0; f < static_cast<Index>(mesh.triangles.rows()); ++f)
            faces[mesh.vertices(mesh.triangles.row(f), 2).mean() < 0.25 ? 0 : 1].push_back(f);
        ExecutionContext context;
        SplitEffort effort;
        std::vector<PartPointer> parts = first_parts(whole, faces, context, effort);
        hide_cuts(whole, {{.part_price = 0.0037, .cut_price = 0.0037}}, parts, context, effort);
        ASSERT_EQ(parts.size(), 2U);
        double low = 10.0, high = -10.0;
        std::size_t count = 0;
        for (const PartPointer& part : parts) {
            EXPECT_TRUE(part->map.measured);
            EXPECT_EQ(part->mesh.surface.loops.size(), 2U);
            count += part->mesh.faces.size();
            for (const VertexLoop& loop : part->mesh.surface.loops)
                for (const Index v : loop)
                    if (const double h = mesh.vertices(part->mesh.original[v], 2); std::abs(h) < 1.9) {
                        low = std::min(low, h);
                        high = std::max(high, h);
                    }
        }
        EXPECT_EQ(count, static_cast<std::size_t>(mesh.triangles.rows()));
        if (groove > 0.0) {
            EXPECT_GT(low, -0.06);
            EXPECT_LT(high, 0.06);
        } else {
            EXPECT_GT(low, 0.2);
            EXPECT_LT(high, 0.3);
        }
    }
}

TEST(DualCut, is_shortest_at_the_waist)
{
    std::vector<std::pair<double, double>> profile;
    for (int k = 0; k <= 20; ++k) profile.emplace_back(k == 12 ? 0.5 : 1.0, 0.3 * k);
    const Mesh mesh = revolved(profile, 16);
    std::vector<Index> all(mesh.triangles.rows());
    for (std::size_t f = 0; f < all.size(); ++f) all[f] = static_cast<Index>(f);
    const PartMesh part = part_mesh(cut_surface(mesh.vertices, mesh.triangles, {}), all);
    std::vector<Side> sides(all.size(), Side::free);
    for (int f = 0; f < 32; ++f) {
        sides[f] = Side::inside;
        sides[sides.size() - 1 - f] = Side::outside;
    }
    const std::vector<int> label = minimum_cut(part, sides);
    ASSERT_EQ(label.size(), all.size());
    for (std::size_t f = 0; f < label.size(); ++f) EXPECT_EQ(label[f], f < 12U * 32U) << f;
}
