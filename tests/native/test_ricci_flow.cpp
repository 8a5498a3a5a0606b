#include "baselines/circle_packing.h"
#include "baselines/ricci_flow.h"
#include "baselines/ricci_uniformize.h"
#include "circle_domain.h"
#include "circles/circle_fit.h"
#include "core/connectivity.h"
#include "flow/curvature.h"
#include "flow/flat_layout.h"
#include "surface/edge_flip.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <numbers>
#include <random>
#include <set>

using namespace koebe;
using namespace koebe::test;

namespace {

using std::numbers::pi;
constexpr Packing packings[] = {Packing::acute, Packing::inversive};

struct FlowSample {
    CircleDomain domain;
    EdgeLengths lengths;
    Index vertex_count;
    std::vector<char> boundary;

    FlowSample(Index faces, Lift kind)
        : domain(make_circle_domain(five_circles(), faces)),
          lengths(edge_lengths(lift(domain.points, kind), domain.triangles)),
          vertex_count(static_cast<Index>(domain.points.size())),
          boundary(vertex_count, 0)
    {
        for (const VertexLoop& loop : domain.loops)
            for (const Index v : loop) boundary[v] = 1;
    }
    CirclePacking packing(Packing kind) const { return circle_packing(domain.triangles, lengths, vertex_count, kind); }
    RicciFlowResult flow(const RicciFlowOptions& options) const
    {
        ExecutionContext context;
        return ricci_flow({domain.triangles, lengths, pair_halfedges(domain.triangles, vertex_count)}, vertex_count,
                          domain.loops, options, context);
    }
    double circle_error(const RicciFlowResult& result) const
    {
        std::vector<Circle> circles;
        for (const VectorXcd& loop : result.outcome.loops) circles.push_back(fit_circle_least_squares(loop));
        return inversive_distance_error(circles, domain.circles);
    }
};

VectorXd disturbed(const VectorXd& values, double spread)
{
    std::mt19937 generator(11);
    std::uniform_real_distribution<double> uniform(-spread, spread);
    VectorXd result = values;
    for (double& value : result) value += uniform(generator);
    return result;
}

}  // namespace

TEST(RicciFlow, inversive_packings_reproduce_the_metric_and_acute_ones_intersect)
{
    const FlowSample sample(900, Lift::enneper);
    const CirclePacking inversive = sample.packing(Packing::inversive);
    EXPECT_LT(inversive.changed, 1e-12);
    EXPECT_GE(inversive.weights.minCoeff(), 1.0 - 1e-12);
    const CirclePacking acute = sample.packing(Packing::acute);
    EXPECT_GE(acute.weights.minCoeff(), 0.0);
    EXPECT_LE(acute.weights.maxCoeff(), 1.0);
    EXPECT_GT(acute.changed, 0.01);
}

TEST(RicciFlow, tangent_circles_of_a_regular_lattice_are_its_packing)
{
    Triangles triangles(2, 3);
    triangles << 0, 1, 2, 2, 1, 3;
    for (const Packing kind : packings) {
        const CirclePacking packing = circle_packing(triangles, EdgeLengths::Constant(2, 3, 2.0), 4, kind);
        EXPECT_LT(packing.log_radii.cwiseAbs().maxCoeff(), 1e-15);
        EXPECT_LT((packing.weights.array() - 1.0).abs().maxCoeff(), 1e-14);
        // The power centre is the incentre, 1 / sqrt(3) from edges of length 2.
        EXPECT_LT((power_weights(triangles, EdgeLengths::Constant(2, 3, 2.0), packing.log_radii).array() -
                   0.5 / std::sqrt(3.0))
                      .abs()
                      .maxCoeff(),
                  1e-14);
    }
}

TEST(RicciFlow, the_hessian_is_the_derivative_of_the_curvature_and_positive_semidefinite)
{
    const FlowSample sample(300, Lift::enneper);
    for (const Packing kind : packings) {
        const CirclePacking packing = sample.packing(kind);
        RicciEnergy energy(sample.domain.triangles, packing, sample.boundary);
        const VectorXd u = disturbed(packing.log_radii, 0.1), direction = disturbed(VectorXd::Zero(u.size()), 1.0);
        energy.gradient(u);
        const MatrixXd hessian = energy.hessian();
        const double h = 1e-5;
        const VectorXd difference =
            (energy.gradient(u + h * direction) - energy.gradient(u - h * direction)) / (2.0 * h);
        EXPECT_LT((hessian * direction - difference).cwiseAbs().maxCoeff(), 1e-6);
        const VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<MatrixXd>(hessian).eigenvalues();
        EXPECT_GT(eigenvalues[0], -1e-12);
        EXPECT_GT(eigenvalues[1], 1e-6);
    }
}

TEST(RicciFlow, curvature_sums_to_two_pi_chi_for_all_radii)
{
    const FlowSample sample(500, Lift::sphere);
    for (const Packing kind : packings) {
        const CirclePacking packing = sample.packing(kind);
        RicciEnergy energy(sample.domain.triangles, packing, sample.boundary);
        for (const double spread : {0.0, 0.5, 5.0})
            EXPECT_NEAR(energy.gradient(disturbed(packing.log_radii, spread)).sum(), -6.0 * pi, 1e-9);
    }
}

TEST(RicciFlow, targets_keep_the_sum_of_every_loop)
{
    const FlowSample sample(900, Lift::enneper);
    for (const BoundaryTarget target : {BoundaryTarget::inscribed, BoundaryTarget::proportional})
        for (const int updates : {1, 4}) {
            const RicciFlowResult result = sample.flow({.target = target, .max_updates = updates, .newton = {}});
            for (std::size_t k = 0; k < sample.domain.loops.size(); ++k) {
                double sum = 0.0;
                for (const Index v : sample.domain.loops[k]) sum += result.target[v];
                EXPECT_NEAR(sum, (k == 0 ? 2.0 : -2.0) * pi, 1e-12);
            }
            EXPECT_FALSE(result.outcome.converged);
            EXPECT_FALSE(result.reason.empty());
        }
}

TEST(RicciFlow, turning_angles_are_those_of_inscribed_polygons)
{
    // A right triangle's vertices are on the circle over its longest side.
    VectorXd edges(3);
    edges << 3.0, 4.0, 5.0;
    VectorXd expected(3);
    expected << pi - std::atan2(4.0, 3.0), pi / 2.0, pi - std::atan2(3.0, 4.0);
    EXPECT_LT((turning_angles(edges, BoundaryTarget::inscribed) - expected).cwiseAbs().maxCoeff(), 1e-7);
    // With the centre outside: an isosceles triangle with 120 degrees at the top.
    edges << 1.0, 1.0, std::sqrt(3.0);
    expected << pi * 5.0 / 6.0, pi / 3.0, pi * 5.0 / 6.0;
    EXPECT_LT((turning_angles(edges, BoundaryTarget::inscribed) - expected).cwiseAbs().maxCoeff(), 1e-12);
    // And any number of equal edges.
    EXPECT_LT((turning_angles(VectorXd::Constant(7, 0.3), BoundaryTarget::inscribed).array() - 2.0 * pi / 7.0)
                  .abs()
                  .maxCoeff(),
              1e-13);
    edges << 1.0, 2.0, 1.0;
    EXPECT_NEAR(turning_angles(edges, BoundaryTarget::proportional)[0], pi / 2.0, 1e-14);
}

TEST(RicciFlow, loops_become_circles_and_holes_close)
{
    const FlowSample sample(2000, Lift::enneper);
    const RicciFlowResult result = sample.flow({.tolerance = 1e-9, .newton = {}});
    EXPECT_TRUE(result.outcome.converged) << result.reason;
    EXPECT_LT(result.closing_gap, 1e-9);
    EXPECT_LT(result.outcome.history.back().mean_roundness.all.least_squares, 1e-8);
    EXPECT_TRUE(result.collapsed.empty());
    // The metric of the map is the flow's: a packing with the same weights.
    const VectorXd K = discrete_curvature(
        sample.domain.triangles,
        edge_lengths(
            (PlanarPoints(sample.vertex_count, 2) << result.positions.real(), result.positions.imag()).finished(),
            sample.domain.triangles),
        sample.boundary);
    EXPECT_LT((K - result.target).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(RicciFlow, proportional_targets_leave_a_gap_and_drift_on)
{
    const FlowSample sample(1000, Lift::enneper);
    const RicciFlowResult result = sample.flow({.target = BoundaryTarget::proportional, .newton = {}});
    EXPECT_FALSE(result.outcome.converged);
    EXPECT_FALSE(result.reason.empty());
    EXPECT_GT(result.closing_gap, 1e-5);
    EXPECT_LT(result.closing_gap, 1e-2);
    EXPECT_LT(sample.circle_error(result), 1e-2);  // along Moebius maps
}

TEST(RicciFlow, slow_the_circles_converge_to_those_of_the_domain)
{
    for (const Lift kind : curved_lifts) {
        double error[2];
        for (int i = 0; i < 2; ++i) {
            const FlowSample sample(i == 0 ? 1000 : 16000, kind);
            const RicciFlowResult result = sample.flow({});
            EXPECT_TRUE(result.outcome.converged) << result.reason;
            error[i] = sample.circle_error(result);
        }
        EXPECT_LT(error[1], 1e-4) << to_string(kind);
        EXPECT_GT(std::log2(error[0] / error[1]), 1.8 * 2.0) << to_string(kind);
    }
}

TEST(RicciFlow, a_boundary_vertex_with_one_face_at_a_hole_cannot_be_met_and_is_reported)
{
    // The angle at an ear of a hole would have to exceed pi.
    FlowSample sample(600, Lift::plane);
    const Index a = sample.domain.loops[1][0], b = sample.domain.loops[1][1];
    Triangles triangles(sample.domain.triangles.rows() + 1, 3);
    triangles << sample.domain.triangles, b, a, sample.vertex_count;
    EdgeLengths lengths(triangles.rows(), 3);
    const double edge = std::abs(sample.domain.points[a] - sample.domain.points[b]);
    lengths << sample.lengths, edge, edge, edge;
    std::vector<VertexLoop> loops = sample.domain.loops;
    loops[1].insert(loops[1].begin() + 1, sample.vertex_count);
    ExecutionContext context;
    const RicciFlowResult result =
        ricci_flow({triangles, lengths, pair_halfedges(triangles, sample.vertex_count + 1)}, sample.vertex_count + 1,
                   loops, {.max_updates = 20, .newton = {}}, context);
    EXPECT_FALSE(result.outcome.converged);
    EXPECT_FALSE(result.reason.empty());
    EXPECT_TRUE(result.positions.allFinite());
    // uniformize's way round it: the ear is cut off first.
    Vertices vertices(sample.vertex_count + 1, 3);
    vertices.topRows(sample.vertex_count) = lift(sample.domain.points, Lift::plane);
    const Complex tip =
        0.5 * (sample.domain.points[a] + sample.domain.points[b]) * 0.9 + 0.1 * sample.domain.circles[1].center;
    vertices.bottomRows(1) << tip.real(), tip.imag(), 0.0;
    const UniformizeResult whole = ricci_uniformize(vertices, triangles, {}, context);
    EXPECT_TRUE(whole.converged);
    EXPECT_TRUE(whole.distortion.flipped.empty());
}

TEST(RicciFlow, two_loops_become_concentric)
{
    const CircleDomain domain = make_circle_domain({{{0.0, 0.0}, 1.0}, {{0.4, 0.2}, 0.25}}, 2000);
    ExecutionContext context;
    const UniformizeResult result = ricci_uniformize(lift(domain.points, Lift::sphere), domain.triangles, {}, context);
    EXPECT_TRUE(result.converged);
    EXPECT_LT(std::abs(result.loops[1].circle.center), 1e-6);
    EXPECT_NEAR(-std::log(result.loops[1].circle.radius),
                std::acosh(inversive_distance(domain.circles[0], domain.circles[1])), 0.02);
}

TEST(RicciFlow, needles_of_the_given_triangulation_collapse_and_intrinsic_delaunay_flips_spare_them)
{
    // A good mesh whose inner edges have been flipped at random, as long as the faces stay the right way round.
    const FlowSample sample(1500, Lift::polynomial);
    const Vertices vertices = lift(sample.domain.points, Lift::polynomial);
    const auto area = [&](Index a, Index b, Index c) {
        const Eigen::RowVector3d u = vertices.row(b) - vertices.row(a), v = vertices.row(c) - vertices.row(a);
        return u[0] * v[1] - u[1] * v[0];
    };
    Triangles triangles = sample.domain.triangles;
    EdgeLengths lengths = sample.lengths;
    std::vector<Index> twin = pair_halfedges(triangles, sample.vertex_count);
    std::mt19937 generator(3);
    std::set<std::pair<Index, Index>> edges;
    for (Index h = 0; h < static_cast<Index>(twin.size()); ++h)
        edges.insert(std::minmax(origin(triangles, h), target(triangles, h)));
    for (int i = 0; i < 4000; ++i) {
        const Index h = static_cast<Index>(generator() % twin.size()), t = twin[h];
        if (t == no_twin) continue;
        const Index a = origin(triangles, h), b = origin(triangles, t);
        const Index c = origin(triangles, previous_halfedge(h)), d = origin(triangles, previous_halfedge(t));
        if (sample.boundary[a] || sample.boundary[b] || sample.boundary[c] || sample.boundary[d]) continue;
        if (area(d, c, a) <= 0.0 || area(c, d, b) <= 0.0 || !edges.insert(std::minmax(c, d)).second) continue;
        edges.erase(std::minmax(a, b));
        flip_edge(triangles, lengths, twin, h, (vertices.row(c) - vertices.row(d)).norm());
    }
    ExecutionContext context;
    const UniformizeResult given = ricci_uniformize(vertices, triangles, {.common = {}, .delaunay = false}, context);
    const UniformizeResult flipped = ricci_uniformize(vertices, triangles, {}, context);
    EXPECT_FALSE(given.converged);
    EXPECT_TRUE(flipped.converged);
    for (const UniformizeResult* result : {&given, &flipped}) {
        EXPECT_TRUE(result->uv.allFinite());
        for (const LoopReport& loop : result->loops) EXPECT_FALSE(loop.vertices.empty());
    }
}

TEST(FlatLayout, a_flat_mesh_comes_back_by_both_ways_and_a_gap_is_shared)
{
    const FlowSample sample(900, Lift::plane);
    const std::vector<Index> twin = pair_halfedges(sample.domain.triangles, sample.vertex_count);
    VectorXcd edges = unfolded_edges(sample.domain.triangles, sample.lengths, twin);
    const auto off = [&](const VectorXcd& positions) {
        // The best motion taken out.
        const VectorXcd a = sample.domain.points.array() - sample.domain.points.mean();
        const VectorXcd b = positions.array() - positions.mean();
        const Complex turn = b.dot(a) / b.squaredNorm();
        EXPECT_NEAR(std::abs(turn), 1.0, 1e-3);
        return (a - turn * b).cwiseAbs().maxCoeff();
    };
    EXPECT_LT(off(positions_along_tree(sample.domain.triangles, edges, sample.vertex_count)), 1e-11);
    EXPECT_LT(off(positions_from_edges(sample.domain.triangles, sample.lengths, edges, sample.vertex_count)), 1e-11);
    edges[5] *= 1.01;  // one half-edge that does not close up: felt nearby, and by less than itself
    const double moved = off(positions_from_edges(sample.domain.triangles, sample.lengths, edges, sample.vertex_count));
    EXPECT_GT(moved, 1e-6);
    EXPECT_LT(moved, 0.01 * std::abs(edges[5]));
}

TEST(ConvexNewton, a_curvature_that_no_metric_has_makes_the_factors_run_away_and_is_reported)
{
    // Two triangles on an edge: 3 pi of curvature at one corner would take a negative angle there.
    Triangles triangles(2, 3);
    triangles << 0, 1, 2, 2, 1, 3;
    const std::vector<char> boundary(4, 1);
    RicciEnergy energy(triangles, circle_packing(triangles, EdgeLengths::Ones(2, 3), 4, Packing::inversive), boundary);
    VectorXd target(4);
    target << 1.5 * pi, 0.0, 0.0, 0.5 * pi;
    energy.set_target(target);
    VectorXd u = VectorXd::Zero(4);
    ExecutionContext context;
    const NewtonReport report = ConvexNewton().minimize(energy, u, {}, context);
    EXPECT_FALSE(report.converged);
    EXPECT_FALSE(report.reason.empty());
    EXPECT_EQ(report.residuals.size(), static_cast<std::size_t>(report.steps + 1));
    EXPECT_GT(report.residuals.back(), 0.1);
}
