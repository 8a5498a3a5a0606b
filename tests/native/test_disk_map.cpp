#include "circle_domain.h"
#include "circles/moebius.h"
#include "conformal/disk_map.h"
#include "core/errors.h"
#include "mesh/topology.h"
#include "random_disks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace koebe;
using namespace koebe::test;

namespace {

CircleDomain disk(Index faces) { return make_circle_domain({Circle{}}, faces); }

DiskMap map_of(const CircleDomain& domain, Lift kind, const DiskMapOptions& options)
{
    return disk_map(domain.triangles, edge_lengths(lift(domain.points, kind), domain.triangles),
                    static_cast<Index>(domain.points.size()), domain.loops[0], options);
}

/// Largest distance from the automorphism of the disk that takes the domain's point p to the origin, which Riemann's
/// map is for every conformal lift, the best rotation taken out.
double error_of(const CircleDomain& domain, const DiskMap& map)
{
    const VectorXcd expected = Moebius{domain.points[map.center], Complex(1.0, 0.0)}(domain.points);
    Complex turn = (map.positions.array() * expected.array().conjugate()).sum();
    turn /= std::abs(turn);
    return (map.positions.array() - turn * expected.array()).abs().maxCoeff();
}

}  // namespace

TEST(DiskMap, is_riemanns_map_with_second_order_under_every_conformal_lift)
{
    for (const Lift kind : {Lift::plane, Lift::polynomial, Lift::sphere, Lift::enneper}) {
        double first = 0.0, last = 0.0;
        for (const Index faces : {1000, 16000}) {
            const CircleDomain domain = disk(faces);
            last = error_of(domain, map_of(domain, kind, {.center = vertex_near(domain, {0.3, -0.2})}));
            if (first == 0.0) first = last;
        }
        EXPECT_LT(last, 1e-3) << to_string(kind);
        EXPECT_GT(std::log2(first / last), 1.7 * 2.0) << to_string(kind) << " " << first << " -> " << last;
    }
}

TEST(DiskMap, puts_p_at_the_origin_and_the_boundary_on_the_circle)
{
    const CircleDomain domain = disk(1000);
    const Index p = vertex_near(domain, {-0.5, 0.1});
    const DiskMap map = map_of(domain, Lift::enneper, {.center = p});
    EXPECT_EQ(map.center, p);
    EXPECT_LT(std::abs(map.positions[p]), 1e-15);
    for (const Index v : domain.loops[0]) EXPECT_NEAR(std::abs(map.positions[v]), 1.0, 1e-15);
}

TEST(DiskMap, the_annulus_grows_to_the_disk_as_the_removed_disk_shrinks)
{
    // Each halving of D_n halves the inner radius, and the maps approach a limit.
    const CircleDomain domain = disk(1000);
    const Index p = vertex_near(domain, {0.3, -0.2});
    VectorXcd before;
    double radius = 0.0, change = 0.0;
    for (const int halvings : {1, 2, 3, 4, 5, 6}) {
        const DiskMap map = map_of(domain, Lift::polynomial, {.center = p, .halvings = halvings});
        if (halvings > 1) {
            EXPECT_NEAR(map.hole_radius / radius, 0.5, 0.04);
            const double moved = (map.positions - before).cwiseAbs().maxCoeff();
            if (halvings > 2) {
                EXPECT_LT(moved, 0.6 * change);
            }
            change = moved;
        }
        radius = map.hole_radius;
        before = map.positions;
    }
    EXPECT_LT(change, 1e-4);
}

TEST(DiskMap, chooses_the_middle_of_a_round_disk)
{
    const CircleDomain domain = disk(4000);
    EXPECT_LT(std::abs(domain.points[map_of(domain, Lift::plane, {}).center]), 0.05);
}

TEST(DiskMap, meshes_without_inner_vertices_have_a_map_too)
{
    Triangles triangle(1, 3);
    triangle << 0, 1, 2;
    const DiskMap map = disk_map(triangle, EdgeLengths::Constant(1, 3, 2.0), 3, {0, 1, 2});
    EXPECT_EQ(map.center, -1);
    for (int k = 0; k < 3; ++k)
        EXPECT_LT(std::abs(map.positions[(k + 1) % 3] / map.positions[k] - std::polar(1.0, 2.0 * M_PI / 3.0)), 1e-9);

    Triangles strip(3, 3);
    strip << 0, 1, 2, 2, 1, 3, 2, 3, 4;
    const DiskMap other = disk_map(strip, EdgeLengths::Ones(3, 3), 6, {0, 1, 3, 4, 2});
    for (const Index v : {0, 1, 2, 3, 4}) EXPECT_NEAR(std::abs(other.positions[v]), 1.0, 1e-14);
    EXPECT_EQ(other.positions[5], Complex(0.0, 0.0));
}

TEST(DiskMap, a_centre_on_the_boundary_or_nowhere_is_refused)
{
    const CircleDomain domain = disk(200);
    EXPECT_THROW(map_of(domain, Lift::plane, {.center = domain.loops[0][3]}), InputError);
    EXPECT_THROW(map_of(domain, Lift::plane, {.center = static_cast<Index>(domain.points.size())}), InputError);
    EXPECT_THROW(map_of(domain, Lift::plane, {.halvings = 0}), InputError);
}

TEST(DiskMap, never_leaves_the_closed_disk)
{
    // Points anywhere make obtuse faces, whose negative weights take some maps out of the disk.
    int maps = 0, errors = 0;
    for (unsigned seed = 0; seed < 100; ++seed) {
        std::mt19937 random(seed);
        const Triangles triangles = as_triangles(flipped_at_random(limb(4, 5), 60, random));
        Vertices vertices(21, 3);
        for (double& x : vertices.reshaped()) x = static_cast<double>(random()) * 0x1p-32;
        const Surface surface = require_bordered_genus_zero(triangles, 21);
        const EdgeLengths lengths = edge_lengths(vertices, surface.triangles);
        const auto farthest = [&](bool inside) {
            return disk_map(surface.triangles, lengths, 21, surface.loops[0], {.inside = inside})
                .positions.cwiseAbs()
                .maxCoeff();
        };
        const double outside = farthest(false);
        try {
            EXPECT_LE(farthest(true), 1.0 + 1e-9);
            ++maps;
        } catch (const SolverError& error) {
            EXPECT_FALSE(error.elements().empty());
            EXPECT_GT(outside, 1.0 + 1e-9);
            ++errors;
        }
    }
    EXPECT_GT(maps, 0);
    EXPECT_GT(errors, 0);
}
