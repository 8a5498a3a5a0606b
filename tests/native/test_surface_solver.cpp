#include "circle_domain.h"
#include "circles/boundary_angles.h"
#include "circles/point_alignment.h"
#include "core/errors.h"
#include "loop_circles.h"
#include "pipeline/surface_solver.h"
#include "pipeline/uniformize.h"
#include "surface/intrinsic_metric.h"
#include "surface/loop_edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace koebe;
using namespace koebe::test;

namespace {

/// The exact domain, lifted; its vertices swell by a smooth field.
struct SolverSample : LiftedDomain {
    SolverSample() : LiftedDomain(4000, Lift::sphere) {}

    Vertices moved(double amount) const
    {
        Vertices result = vertices;
        for (Eigen::Index v = 0; v < result.rows(); ++v)
            for (int c = 0; c < 3; ++c) result(v, c) += amount * std::sin(3.0 * vertices(v, (c + 1) % 3) + c);
        return result;
    }
};

UniformizeOptions on_loop_of(Index vertex)
{
    UniformizeOptions options;
    options.outer = OuterLoop::vertex;
    options.outer_vertex = vertex;
    return options;
}

/// How far the circles are from others, up to an automorphism of the disk.
double difference(const UniformizeResult& a, const UniformizeResult& b)
{
    EXPECT_EQ(a.loops[0].vertices, b.loops[0].vertices);
    std::vector<Circle> ordered;  // b's, as a's
    for (const LoopReport& loop : a.loops)
        for (const LoopReport& other : b.loops)
            if (other.vertices == loop.vertices) ordered.push_back(other.circle);
    return inversive_distance_error(ordered, circles_of(a.loops));
}

}  // namespace

TEST(SurfaceSolver, first_map_is_that_of_uniformize_to_the_bit)
{
    const SolverSample sample;
    SurfaceSolver surface(sample.vertices, sample.domain.triangles);
    const UniformizeResult fresh = uniformize(sample.vertices, sample.domain.triangles);
    EXPECT_TRUE(surface.uniformize(sample.vertices).uv == fresh.uv);
}

TEST(SurfaceSolver, moved_map_is_that_of_uniformize_up_to_an_automorphism)
{
    const SolverSample sample;
    SurfaceSolver surface(sample.vertices, sample.domain.triangles);
    const Index outer = surface.uniformize(sample.vertices).loops[0].vertices[0];
    for (const double amount : {0.001, 0.02, 0.2, 0.02, 0.0}) {
        const Vertices there = sample.moved(amount);
        const UniformizeResult again = surface.uniformize(there);
        const UniformizeResult fresh = uniformize(there, sample.domain.triangles, on_loop_of(outer));
        EXPECT_TRUE(again.converged);
        EXPECT_TRUE(again.distortion.flipped.empty());
        // Up to what the mesh resolves: its triangulation is kept while it is nearly Delaunay.
        EXPECT_LT(difference(again, fresh), 1e-4) << amount;
        EXPECT_NEAR(again.distortion.angle_error_deg.mean, fresh.distortion.angle_error_deg.mean, 0.01) << amount;
    }
}

TEST(SurfaceSolver, a_small_step_takes_one_sweep)
{
    const SolverSample sample;
    SurfaceSolver surface(sample.vertices, sample.domain.triangles);
    EXPECT_GT(surface.uniformize(sample.vertices).sweeps, 1);
    EXPECT_EQ(surface.uniformize(sample.moved(2e-5)).sweeps, 1);
}

TEST(SurfaceSolver, a_motion_takes_one_sweep_a_frame_and_is_as_near_as_by_many)
{
    const SolverSample sample;
    SurfaceSolver surface(sample.vertices, sample.domain.triangles);
    UniformizeOptions exact;
    exact.tolerance = 1e-12;
    SurfaceSolver by_many(sample.vertices, sample.domain.triangles, exact);
    std::vector<int> sweeps;
    for (int frame = 0; frame < 8; ++frame) {
        const Vertices there = sample.moved(0.04 * std::sin(0.3 * frame));
        const UniformizeResult map = surface.uniformize(there), best = by_many.uniformize(there);
        EXPECT_TRUE(map.converged);
        EXPECT_LT(difference(map, best), 1e-6) << frame;
        sweeps.push_back(map.sweeps);
    }
    for (std::size_t frame = 3; frame < sweeps.size(); ++frame) EXPECT_EQ(sweeps[frame], 1) << frame;
    EXPECT_GT(sweeps[1], 1);  // from the last angles alone
}

TEST(SurfaceSolver, a_motion_gives_the_same_bits_again_and_on_any_number_of_threads)
{
    const SolverSample sample;
    const auto maps = [&](int threads) {
        UniformizeOptions options;
        options.threads = threads;
        SurfaceSolver surface(sample.vertices, sample.domain.triangles, options);
        std::vector<PlanarPoints> uvs;
        for (int frame = 0; frame < 6; ++frame)
            uvs.push_back(surface.uniformize(sample.moved(0.04 * std::sin(0.3 * frame))).uv);
        return uvs;
    };
    const std::vector<PlanarPoints> expected = maps(1);
    for (const int threads : {1, 3}) EXPECT_TRUE(maps(threads) == expected) << threads;
}

TEST(SurfaceSolver, other_triangles_and_the_same_ones_again)
{
    const SolverSample sample;
    for (const bool two_loops : {false, true}) {
        const CircleDomain domain = two_loops ? make_circle_domain({Circle{}, {{0.2, 0.1}, 0.3}}, 2000) : sample.domain;
        const Vertices still = lift(domain.points, Lift::sphere);
        SurfaceSolver surface(still, domain.triangles);
        const Index outer = surface.uniformize(still).loops[0].vertices[0];
        for (const double squeeze : {1.0, 0.3, 0.31, 0.32, 1.0, 0.99, 0.98, 0.97}) {  // on two triangulations
            Vertices there = still;
            there.col(0) *= squeeze;
            const UniformizeResult again = surface.uniformize(there);
            const UniformizeResult fresh = uniformize(there, domain.triangles, on_loop_of(outer));
            EXPECT_TRUE(again.converged);
            EXPECT_LT(difference(again, fresh), 2e-3) << squeeze;
            EXPECT_NEAR(again.distortion.angle_error_deg.mean, fresh.distortion.angle_error_deg.mean, 0.02) << squeeze;
        }
    }
}

TEST(SurfaceSolver, maps_are_laid_over_the_first)
{
    const SolverSample sample;
    SurfaceSolver surface(sample.vertices, sample.domain.triangles);
    const UniformizeResult first = surface.uniformize(sample.vertices);
    // A turn and a scale change no shape.
    Vertices turned = 7.0 * sample.vertices;
    turned.col(0) = -turned.col(0).eval();
    turned.col(1) = -turned.col(1).eval();
    EXPECT_LT((surface.uniformize(turned).uv - first.uv).rowwise().norm().maxCoeff(), 1e-6);
    EXPECT_LT((surface.uniformize(sample.moved(0.02)).uv - first.uv).rowwise().norm().mean(), 0.02);
    // No automorphism brings the loops nearer, each vertex weighed by its share of the length.
    for (const double amount : {0.02, 0.2}) {
        const Vertices there = sample.moved(amount);
        const UniformizeResult moved = surface.uniformize(there);
        std::vector<Complex> points, targets;
        std::vector<double> weights;
        for (const LoopReport& loop : moved.loops) {
            const VectorXd edges = loop_edges(there, loop.vertices), share = vertex_weights(edges);
            for (std::size_t b = 0; b < loop.vertices.size(); ++b) {
                const Index v = loop.vertices[b];
                points.emplace_back(moved.uv(v, 0), moved.uv(v, 1));
                targets.emplace_back(first.uv(v, 0), first.uv(v, 1));
                weights.push_back(share[static_cast<Eigen::Index>(b)] * edges.sum());
            }
        }
        const auto count = static_cast<Eigen::Index>(points.size());
        const Moebius rest = nearest_automorphism(Eigen::Map<const VectorXcd>(points.data(), count),
                                                  Eigen::Map<const VectorXcd>(targets.data(), count),
                                                  Eigen::Map<const VectorXd>(weights.data(), count));
        EXPECT_LT(std::abs(rest.a), 1e-4) << amount;  // the images are put on circles after that
        EXPECT_LT(std::abs(rest.turn - 1.0), 1e-4) << amount;
    }
    // Back again, perhaps on other triangles of the same metric.
    EXPECT_LT((surface.uniformize(turned).uv - first.uv).rowwise().norm().maxCoeff(), 1e-3);
}

TEST(SurfaceSolver, the_first_outer_loop_stays)
{
    const CircleDomain domain = make_circle_domain({{{0.0, 0.0}, 1.0}, {{0.0, 0.0}, 0.8}}, 1000);
    Vertices plate = Vertices::Zero(domain.points.size(), 3);
    plate.col(0) = domain.points.real();
    plate.col(1) = domain.points.imag();
    SurfaceSolver surface(plate, domain.triangles);
    const VertexLoop outer = surface.uniformize(plate).loops[0].vertices;
    for (Eigen::Index v = 0; v < plate.rows(); ++v) {  // the inner loop becomes the longer one: a cone
        const double r = std::hypot(plate(v, 0), plate(v, 1));
        plate.row(v).head<2>() *= (1.9 - r) / r;
    }
    EXPECT_EQ(surface.uniformize(plate).loops[0].vertices, outer);
    EXPECT_NE(uniformize(plate, domain.triangles).loops[0].vertices, outer);
}

TEST(SurfaceSolver, errors_leave_it_usable)
{
    const SolverSample sample;
    SurfaceSolver surface(sample.vertices, sample.domain.triangles);
    const UniformizeResult first = surface.uniformize(sample.vertices);
    EXPECT_THROW(surface.uniformize(sample.vertices.topRows(10)), InputError);
    Vertices torn = sample.vertices;
    torn(3, 1) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(surface.uniformize(torn), InputError);
    EXPECT_THROW(surface.uniformize(Vertices::Zero(sample.vertices.rows(), 3)), InputError);
    CancelToken token;
    token.cancel();
    ExecutionContext cancelled({}, token);
    EXPECT_THROW(surface.uniformize(sample.moved(0.01), cancelled), Cancelled);
    EXPECT_LT((surface.uniformize(sample.vertices).uv - first.uv).rowwise().norm().maxCoeff(), 1e-6);

    UniformizeOptions mesh_engine;
    mesh_engine.engine = Engine::mesh;
    EXPECT_THROW(SurfaceSolver(sample.vertices, sample.domain.triangles, mesh_engine), InputError);
}

TEST(SurfaceSolver, surfaces_that_flatten_or_fold_keep_the_promises)
{
    const SolverSample sample;
    SurfaceSolver surface(sample.vertices, sample.domain.triangles);
    surface.uniformize(sample.vertices);
    std::srand(5);
    for (const double noise : {0.01, 0.1, 1.0}) {  // from wrinkles to a heap of triangles
        const Vertices there = sample.vertices + noise * Vertices::Random(sample.vertices.rows(), 3);
        const UniformizeResult result = surface.uniformize(there);
        EXPECT_TRUE(result.uv.allFinite());
        EXPECT_LE(result.uv.rowwise().norm().maxCoeff(), 1.0 + 1e-9);
        if (result.converged) {
            EXPECT_TRUE(result.distortion.flipped.empty()) << noise;
        }
    }
}

TEST(IntrinsicMetric, the_same_flips_on_other_positions_give_the_same_triangles)
{
    const SolverSample sample;
    const Surface topology = analyze_surface(sample.domain.triangles, static_cast<Index>(sample.vertices.rows()));
    const Vertices there = sample.moved(0.3);
    const IntrinsicMetric first = intrinsic_metric(there, topology);
    const auto same = metric_with_flips_of(first, there, topology);
    ASSERT_TRUE(same);
    EXPECT_TRUE(same->triangles == first.triangles);
    EXPECT_TRUE(same->lengths == first.lengths);
    EXPECT_EQ(same->flips, first.flips);
    Vertices squeezed = there;
    squeezed.col(0) *= 0.05;
    EXPECT_FALSE(metric_with_flips_of(first, squeezed, topology));
    EdgeLengths halves;
    ASSERT_TRUE(metric_with_flips_of(first, there, topology, &halves));
    EXPECT_TRUE(halves == half_cotangents(first.lengths));
}

TEST(PointAlignment, finds_the_automorphism_that_was_applied)
{
    std::srand(3);
    const VectorXcd points = 0.6 * VectorXcd::Random(50);
    const VectorXd weights = VectorXd::Random(50).cwiseAbs();
    const Moebius applied{{0.3, -0.5}, std::polar(1.0, 2.0)};
    const Moebius found = nearest_automorphism(points, applied(points), weights);
    EXPECT_LT(std::abs(found.a - applied.a), 1e-9);
    EXPECT_LT(std::abs(found.turn - applied.turn), 1e-9);
}
