#include "circle_domain.h"
#include "circles/circle_fit.h"
#include "conformal/annulus_map.h"
#include "core/errors.h"
#include "flow/curvature.h"
#include "flow/yamabe_flow.h"
#include "mesh/topology.h"
#include "second_order.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <numbers>
#include <random>

using namespace koebe;
using namespace koebe::test;

namespace {

using std::numbers::pi;

EdgeLengths lengths_of(const CircleDomain& domain, Lift kind)
{
    return edge_lengths(lift(domain.points, kind), domain.triangles);
}

VectorXd random_factors(Eigen::Index size, double spread)
{
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> uniform(-spread, spread);
    VectorXd u(size);
    for (double& value : u) value = uniform(generator);
    return u;
}

AnnulusMap yamabe_map(const CircleDomain& domain, const EdgeLengths& lengths, bool flips = true)
{
    return annulus_map(domain.triangles, lengths, static_cast<Index>(domain.points.size()), domain.loops[0],
                       domain.loops[1], {.backend = AnnulusBackend::yamabe, .flips = flips});
}

double module_error(double inner_radius, const CircleDomain& domain)
{
    const double module = std::acosh(inversive_distance(domain.circles[0], domain.circles[1]));
    return std::abs(-std::log(inner_radius) / module - 1.0);
}

/// The part of a triangular lattice inside a square of n x n steps: regular but for its boundary.
struct TriangleLattice {
    EdgeLengths lengths;
    Triangles triangles;
    Index vertex_count;
};

TriangleLattice lattice(Index n)
{
    TriangleLattice mesh{EdgeLengths::Ones(2 * n * n, 3), Triangles(2 * n * n, 3), (n + 1) * (n + 1)};
    Index f = 0;
    for (Index i = 0; i < n; ++i)
        for (Index j = 0; j < n; ++j) {
            const Index a = i * (n + 1) + j, b = a + 1, c = a + n + 1, d = c + 1;
            mesh.triangles.row(f++) << a, b, c;
            mesh.triangles.row(f++) << b, d, c;
        }
    return mesh;
}

/// A flat annulus of 8 rings whose vertices, but those near the boundary, are pulled to heights at random: faces that
/// are needles, in every direction.
EdgeLengths rugged_lengths(const CircleDomain& domain, double height)
{
    Vertices vertices = lift(domain.points, Lift::plane);
    const Eigen::Index margin = 2 * vertices.rows() / 9, inner = vertices.rows() - 2 * margin;
    vertices.col(2).segment(margin, inner) = random_factors(inner, height);
    return edge_lengths(vertices, domain.triangles);
}

}  // namespace

TEST(YamabeFlow, curvature_sums_to_two_pi_chi_at_every_scale)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 900);
    const VectorXd target =
        discrete_curvature(domain.triangles, lengths_of(domain, Lift::plane),
                           boundary_mask(analyze_surface(domain.triangles, static_cast<Index>(domain.points.size()))));
    EXPECT_NEAR(target.sum(), 2.0 * pi * (1 - 4), 1e-9);
    for (const bool flips : {false, true}) {
        YamabeEnergy energy(domain.triangles, lengths_of(domain, Lift::enneper), target, flips);
        for (const double spread : {0.0, 0.3, 5.0})
            EXPECT_NEAR(energy.gradient(random_factors(target.size(), spread)).sum(), 0.0, 1e-9) << spread;
        EXPECT_EQ(energy.flips() > 0, flips);
    }
}

TEST(YamabeFlow, the_hessian_is_the_derivative_of_the_gradient_and_positive_semidefinite)
{
    const CircleDomain domain = eccentric_annulus(300);
    const Eigen::Index n = domain.points.size();
    for (const bool flips : {false, true}) {
        YamabeEnergy energy(domain.triangles, lengths_of(domain, Lift::enneper), VectorXd::Zero(n), flips);
        const VectorXd u = random_factors(n, 0.2), direction = random_factors(n, 1.0).reverse();
        energy.gradient(u);
        const MatrixXd hessian = energy.hessian();
        const double h = 1e-5;
        const VectorXd difference =
            (energy.gradient(u + h * direction) - energy.gradient(u - h * direction)) / (2.0 * h);
        EXPECT_LT((hessian * direction - difference).cwiseAbs().maxCoeff(), 1e-6) << flips;
        EXPECT_LT((hessian * VectorXd::Ones(n)).cwiseAbs().maxCoeff(), 1e-12);
        const VectorXd eigenvalues = Eigen::SelfAdjointEigenSolver<MatrixXd>(hessian).eigenvalues();
        EXPECT_GT(eigenvalues[0], -1e-12);
        EXPECT_GT(eigenvalues[1], 1e-6);
    }
}

TEST(YamabeFlow, the_gradient_is_monotone_where_faces_collapse_too)
{
    // A differentiable function is convex if and only if its gradient is monotone.
    const CircleDomain domain = eccentric_annulus(300);
    const Eigen::Index n = domain.points.size();
    for (const bool flips : {false, true})
        for (const double spread : {0.1, 2.0, 6.0}) {
            YamabeEnergy energy(domain.triangles, lengths_of(domain, Lift::plane), VectorXd::Zero(n), flips);
            const VectorXd u = random_factors(n, spread), v = random_factors(n, spread).reverse();
            EXPECT_GT((energy.gradient(v) - energy.gradient(u)).dot(v - u), 0.0) << spread;
        }
}

namespace {

/// The vertices on the rim of lattice(8).
std::vector<char> rim_of_lattice(const TriangleLattice& mesh)
{
    std::vector<char> boundary(mesh.vertex_count, 0);
    for (Index v = 0; v < mesh.vertex_count; ++v)
        boundary[v] = v % 9 == 0 || v % 9 == 8 || v < 9 || v >= mesh.vertex_count - 9;
    return boundary;
}

}  // namespace

TEST(YamabeFlow, a_metric_that_has_its_curvature_already_stays)
{
    const TriangleLattice mesh = lattice(8);
    const std::vector<char> boundary = rim_of_lattice(mesh);
    const VectorXd own = discrete_curvature(mesh.triangles, mesh.lengths, boundary);
    for (Index v = 0; v < mesh.vertex_count; ++v)
        if (!boundary[v]) {
            EXPECT_NEAR(own[v], 0.0, 1e-13);
        }
    ExecutionContext context;
    const YamabeResult result = yamabe_flow(mesh.triangles, mesh.lengths, own, {}, context);
    EXPECT_TRUE(result.newton.converged);
    EXPECT_EQ(result.newton.steps, 0);
    EXPECT_LT((result.lengths - mesh.lengths).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(YamabeFlow, it_undoes_a_conformal_change_of_the_metric)
{
    const TriangleLattice mesh = lattice(8);
    const std::vector<char> boundary = rim_of_lattice(mesh);
    const VectorXd own = discrete_curvature(mesh.triangles, mesh.lengths, boundary);
    VectorXd u = random_factors(mesh.vertex_count, 0.5);
    u.array() -= u.mean();
    EdgeLengths scaled = mesh.lengths;
    for (Eigen::Index f = 0; f < scaled.rows(); ++f)
        for (int k = 0; k < 3; ++k)
            scaled(f, k) *= std::exp(0.5 * (u[mesh.triangles(f, k)] + u[mesh.triangles(f, (k + 1) % 3)]));
    ExecutionContext context;
    for (const bool flips : {false, true}) {
        const YamabeResult result = yamabe_flow(mesh.triangles, scaled, own, {.flips = flips, .newton = {}}, context);
        EXPECT_TRUE(result.newton.converged);
        EXPECT_LT((result.u + u).cwiseAbs().maxCoeff(), 1e-9) << flips;
    }
}

TEST(YamabeFlow, a_target_that_breaks_gauss_bonnet_is_refused)
{
    const TriangleLattice mesh = lattice(3);
    ExecutionContext context;
    EXPECT_THROW(yamabe_flow(mesh.triangles, mesh.lengths, VectorXd::Zero(mesh.vertex_count), {}, context), InputError);
}

TEST(YamabeAnnulus, a_flat_cylinder_needs_no_step)
{
    // Rectangles cut in two: as a metric they make a cylinder of girth 24 and height 5.
    const CircleDomain domain = make_round_annulus(0.5, 24, 5);
    EdgeLengths lengths(domain.triangles.rows(), 3);
    for (Eigen::Index f = 0; f < lengths.rows(); f += 2) {
        lengths.row(f) << 1.0, 1.0, std::sqrt(2.0);
        lengths.row(f + 1) << std::sqrt(2.0), 1.0, 1.0;
    }
    const AnnulusMap map = yamabe_map(domain, lengths);
    EXPECT_EQ(map.steps, 0);
    EXPECT_NEAR(map.inner_radius, std::exp(-2.0 * pi * 5.0 / 24.0), 1e-13);
    const Index ring = 24;
    for (Index v = 0; v < 6 * ring; ++v)
        EXPECT_LT(std::abs(map.positions[v] -
                           std::polar(std::pow(map.inner_radius, (v / ring) / 5.0), 2.0 * pi * (v % ring) / ring)),
                  1e-12);
}

TEST(YamabeAnnulus, a_round_annulus_maps_to_itself_with_second_order)
{
    expect_second_order(1e-3, [](const CircleDomain& annulus) {
        const AnnulusMap map = yamabe_map(annulus, lengths_of(annulus, Lift::plane));
        EXPECT_TRUE(map.converged);
        return std::abs(map.inner_radius - 0.3);
    });
}

TEST(YamabeAnnulus, slow_the_module_converges_under_every_conformal_lift)
{
    for (const Lift kind : {Lift::plane, Lift::polynomial, Lift::sphere, Lift::enneper}) {
        double error[2];
        for (int i = 0; i < 2; ++i) {
            const CircleDomain domain = eccentric_annulus(i == 0 ? 1000 : 16000);
            const AnnulusMap map = yamabe_map(domain, lengths_of(domain, kind));
            EXPECT_TRUE(map.converged);
            error[i] = module_error(map.inner_radius, domain);
        }
        EXPECT_LT(error[1], 2e-3) << to_string(kind);
        EXPECT_GT(std::log2(error[0] / error[1]), 1.7 * 2.0) << to_string(kind);
    }
}

TEST(YamabeAnnulus, inverse_stereographic_projection_changes_nothing)
{
    // A Moebius map of space scales every length by factors of its two ends: the same discrete conformal class.
    const CircleDomain domain = eccentric_annulus(1000);
    const AnnulusMap plane = yamabe_map(domain, lengths_of(domain, Lift::plane));
    const AnnulusMap sphere = yamabe_map(domain, lengths_of(domain, Lift::sphere));
    EXPECT_LT((plane.positions - sphere.positions).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(YamabeAnnulus, it_agrees_with_the_harmonic_backend_to_second_order)
{
    double difference[2];
    for (int i = 0; i < 2; ++i) {
        const CircleDomain domain = eccentric_annulus(i == 0 ? 1000 : 16000);
        const EdgeLengths lengths = lengths_of(domain, Lift::enneper);
        const AnnulusMap yamabe = yamabe_map(domain, lengths);
        const AnnulusMap harmonic = annulus_map(domain.triangles, lengths, static_cast<Index>(domain.points.size()),
                                                domain.loops[0], domain.loops[1]);
        Complex turn = (harmonic.positions.array() * yamabe.positions.array().conjugate()).sum();
        turn /= std::abs(turn);
        difference[i] = (harmonic.positions - turn * yamabe.positions).cwiseAbs().maxCoeff();
        for (const Index v : domain.loops[0]) EXPECT_NEAR(std::abs(yamabe.positions[v]), 1.0, 1e-8);
        for (const Index v : domain.loops[1]) EXPECT_NEAR(std::abs(yamabe.positions[v]), yamabe.inner_radius, 1e-8);
    }
    EXPECT_LT(difference[1], 2e-3);
    EXPECT_GT(std::log2(difference[0] / difference[1]), 1.7 * 2.0);
}

TEST(YamabeAnnulus, needles_need_flips)
{
    const CircleDomain domain = make_round_annulus(0.4, 48, 8);
    const EdgeLengths lengths = rugged_lengths(domain, 3.0);
    const AnnulusMap fixed = yamabe_map(domain, lengths, false);
    EXPECT_FALSE(fixed.converged);
    EXPECT_GT(fixed.collapsed, 0);
    EXPECT_TRUE(fixed.positions.allFinite());
    const AnnulusMap flipped = yamabe_map(domain, lengths, true);
    EXPECT_TRUE(flipped.converged);
    EXPECT_EQ(flipped.collapsed, 0);
    EXPECT_LT(flipped.curvature_error, 1e-9);
}
