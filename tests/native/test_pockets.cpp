#include "splitting/pockets.h"

#include "core/connectivity.h"
#include "mesh/topology.h"
#include "parts/parts.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <vector>

namespace {

using namespace koebe;

struct Mesh {
    Vertices vertices;
    Triangles triangles;
};

/// A profile turned round the z axis, from pole to pole. @param profile (r, z), the first and last with r = 0
Mesh turned(const std::vector<std::array<double, 2>>& profile, Index sectors)
{
    const auto rings = static_cast<Index>(profile.size()) - 2, last = 1 + rings * sectors;
    Mesh mesh{Vertices(last + 1, 3), Triangles(2 * rings * sectors, 3)};
    mesh.vertices.row(0) << 0.0, 0.0, profile.front()[1];
    mesh.vertices.row(last) << 0.0, 0.0, profile.back()[1];
    const auto at = [&](Index i, Index k) { return 1 + i * sectors + k % sectors; };
    Eigen::Index f = 0;
    for (Index i = 0; i < rings; ++i)
        for (Index k = 0; k < sectors; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / sectors;
            const auto& [r, z] = profile[static_cast<std::size_t>(i) + 1];
            mesh.vertices.row(at(i, k)) << r * std::cos(angle), r * std::sin(angle), z;
            if (i == 0) mesh.triangles.row(f++) << 0, at(0, k + 1), at(0, k);
            if (i + 1 == rings) {
                mesh.triangles.row(f++) << at(i, k), at(i, k + 1), last;
                continue;
            }
            mesh.triangles.row(f++) << at(i, k), at(i, k + 1), at(i + 1, k + 1);
            mesh.triangles.row(f++) << at(i, k), at(i + 1, k + 1), at(i + 1, k);
        }
    return mesh;
}

/// A ball of radius 1 with a round mouth at the top that leads into a ball of radius `inside`.
Mesh ball_with_mouth(double mouth, double inside, Index steps, Index sectors)
{
    std::vector<std::array<double, 2>> profile;
    const double outer = std::asin(mouth), inner = std::asin(mouth / inside);
    const double depth = std::cos(outer) - inside * std::cos(inner) - 0.05;  // of the inner ball's middle
    for (Index i = 0; i <= steps; ++i) {
        const double angle = (std::numbers::pi - outer) * i / steps;
        profile.push_back({std::sin(angle), -std::cos(angle)});
    }
    for (Index i = 0; i <= steps; ++i) {
        const double angle = inner + (std::numbers::pi - inner) * i / steps;
        profile.push_back({i == steps ? 0.0 : inside * std::sin(angle), depth + inside * std::cos(angle)});
    }
    profile.front()[0] = 0.0;
    return turned(profile, sectors);
}

CutSurface surface_to_cut(Mesh mesh)
{
    mesh.vertices /= std::sqrt(face_areas(mesh.vertices, mesh.triangles).sum());
    return cut_surface(mesh.vertices, analyze_surface(mesh.triangles, static_cast<Index>(mesh.vertices.rows())), {});
}

TEST(Pockets, AMouthIsCutOffAtItsNarrowestLoop)
{
    for (const double mouth : {0.15, 0.25}) {
        constexpr Index sectors = 32, steps = 24;
        const Mesh mesh = ball_with_mouth(mouth, 0.6, steps, sectors);
        const auto rims = pocket_rims(surface_to_cut(mesh));
        ASSERT_EQ(rims.size(), static_cast<std::size_t>(sectors)) << mouth;  // one closed loop
        std::map<Index, int> degree;
        for (const auto& edge : rims)
            for (const Index v : edge) {
                ++degree[v];
                EXPECT_NEAR(mesh.vertices.row(v).head<2>().norm(), mouth, 1e-12);
            }
        for (const auto& [v, edges] : degree) EXPECT_EQ(edges, 2) << v;
    }
}

TEST(Pockets, AShallowHollowIsNone)
{
    // A ball, and one whose upper half is pressed in: nothing narrow leads into the hemisphere.
    constexpr int steps = 24;
    std::vector<std::array<double, 2>> ball, bowl;
    for (int i = 0; i <= steps; ++i) {
        const double angle = std::numbers::pi * i / steps, size = 2 * i > steps ? 0.9 : 1.0;
        const double r = i == 0 || i == steps ? 0.0 : std::sin(angle), z = -std::cos(angle);
        ball.push_back({r, z});
        bowl.push_back({size * r, 2 * i > steps ? -size * z : z});
    }
    EXPECT_TRUE(pocket_rims(surface_to_cut(turned(ball, 32))).empty());
    EXPECT_TRUE(pocket_rims(surface_to_cut(turned(bowl, 32))).empty());
}

TEST(Pockets, NoPartGoesOverARim)
{
    const Mesh mesh = ball_with_mouth(0.15, 0.6, 24, 32);
    ExecutionContext context;
    const PartsResult result = parts_of(mesh.vertices, mesh.triangles, {}, context);
    EXPECT_TRUE(result.converged);
    EXPECT_TRUE(result.distortion.flipped.empty());
    std::set<Index> inside, outside;
    for (std::size_t f = 0; f < result.part.size(); ++f) {
        const Eigen::RowVector3d middle =
            mesh.vertices(mesh.triangles.row(static_cast<Eigen::Index>(f)), Eigen::all).colwise().mean();
        (middle.norm() > 0.96 ? outside : inside).insert(result.part[f]);
    }
    for (const Index part : inside) EXPECT_FALSE(outside.contains(part)) << part;
}

}  // namespace
