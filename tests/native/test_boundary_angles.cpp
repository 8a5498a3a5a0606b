#include "circles/boundary_angles.h"
#include "circles/moebius.h"
#include "core/errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace koebe;
using std::numbers::pi;

namespace {

VectorXd random_edges(Index m) { return (VectorXd::Random(m).array() + 1.5).matrix(); }

VectorXd moved_angles(const VectorXd& angles, const Moebius& moebius)
{
    const VectorXcd z = moebius(unit_circle_points(angles));
    VectorXd result(z.size());
    for (Eigen::Index b = 0; b < z.size(); ++b) result[b] = std::arg(z[b]);
    return result;
}

}  // namespace

TEST(BoundaryAngles, an_even_density_gives_the_angles_of_the_length)
{
    const VectorXd edges = random_edges(30);
    int raised = 0;
    const VectorXd angles = angles_from_flux(vertex_weights(edges), edges, raised);
    EXPECT_EQ(raised, 0);
    EXPECT_LT((angles - arc_length_angles(edges)).cwiseAbs().maxCoeff(), 1e-14);
    // The sign of the flux and its size do not matter.
    EXPECT_LT((angles_from_flux(-7.0 * vertex_weights(edges), edges, raised) - angles).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(BoundaryAngles, a_smooth_density_is_integrated_to_second_order)
{
    // theta = s + 0.3 sin s on unevenly spaced s; the flux of node b is the integral of theta' over its hat function.
    double last = 0.0;
    for (const Index m : {40, 80, 160}) {
        VectorXd s(m + 1);
        for (Index b = 0; b <= m; ++b) {
            const double t = 2.0 * pi * b / m;
            s[b] = t + 0.4 * std::sin(2.0 * t) / 2.0 + (b % 2 == 1 ? 0.3 * 2.0 * pi / m : 0.0);
        }
        VectorXd edges(m), flux = VectorXd::Zero(m);
        for (Index b = 0; b < m; ++b) {
            edges[b] = s[b + 1] - s[b];
            for (int q = 0; q < 200; ++q) {
                const double x = (q + 0.5) / 200.0;
                const double density = (1.0 + 0.3 * std::cos(s[b] + x * edges[b])) * edges[b] / 200.0;
                flux[b] += (1.0 - x) * density;
                flux[(b + 1) % m] += x * density;
            }
        }
        int raised = 0;
        const VectorXd angles = angles_from_flux(flux, edges, raised);
        double error = 0.0;
        for (Index b = 0; b < m; ++b)
            error = std::max(error, std::abs(angles[b] - (s[b] - s[0] + 0.3 * (std::sin(s[b]) - std::sin(s[0])))));
        if (m > 40) {
            EXPECT_LT(error, last / 3.3);
        }
        last = error;
    }
}

TEST(BoundaryAngles, are_of_fourth_order_on_even_loops)
{
    // theta' = 1 + 0.3 cos s, known at the nodes.
    double last = 0.0;
    for (const Index m : {40, 80, 160}) {
        const VectorXd s = VectorXd::LinSpaced(m, 0.0, 2.0 * pi * static_cast<double>(m - 1) / static_cast<double>(m));
        int raised = 0;
        const VectorXd angles = angles_from_flux(1.0 + 0.3 * s.array().cos(), VectorXd::Ones(m), raised);
        const double error = (angles.array() - s.array() - 0.3 * s.array().sin()).abs().maxCoeff();
        if (m > 40) {
            EXPECT_LT(error, last / 14.0);
        }
        last = error;
    }
}

TEST(BoundaryAngles, nodes_without_flux_stay_apart)
{
    VectorXd flux = VectorXd::Ones(20);
    flux.segment(5, 4).setZero();
    int raised = 0;
    const VectorXd angles = angles_from_flux(flux, VectorXd::Ones(20), raised);
    EXPECT_EQ(raised, 3);
    for (Index b = 1; b < 20; ++b) EXPECT_GT(angles[b], angles[b - 1]);
    EXPECT_LT(angles[19], 2.0 * pi);
    EXPECT_THROW(angles_from_flux(VectorXd::Zero(20), VectorXd::Ones(20), raised), SolverError);
}

TEST(BoundaryAngles, centring_forgets_the_automorphism)
{
    const VectorXd edges = random_edges(50), weights = vertex_weights(edges);
    const VectorXd centered = centered_angles(arc_length_angles(edges), weights);
    const VectorXcd z = unit_circle_points(centered);
    EXPECT_LT(std::abs((weights.array() * z.array()).sum()), 1e-14);
    for (const Complex a : {Complex(0.5, 0.2), Complex(-0.1, 0.9), Complex(0.0, -0.99)}) {
        const Moebius moebius{a, std::polar(1.0, 2.0)};
        const VectorXd again = centered_angles(moved_angles(centered, moebius), weights, centered);
        EXPECT_LT((unit_circle_points(again) - z).cwiseAbs().maxCoeff(), 1e-11) << a;
    }
}
