#include "iteration/disk_dirichlet_to_neumann.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace koebe;
using std::numbers::pi;

namespace {

VectorXd equal_angles(Index m) { return VectorXd::LinSpaced(m, 0.0, 2.0 * pi * (m - 1) / m); }

/// Increasing angles whose neighbouring gaps differ by up to `spread`.
VectorXd uneven_angles(Index m, double spread)
{
    VectorXd gaps = VectorXd::Random(m).array() * std::log(spread) / 2.0;
    gaps = gaps.array().exp();
    gaps *= 2.0 * pi / gaps.sum();
    VectorXd angles(m);
    angles[0] = 0.3;
    for (Index b = 1; b < m; ++b) angles[b] = angles[b - 1] + gaps[b - 1];
    return angles;
}

/// The defining product S' (C G C') S - P of docs/numerics.md, from the series of the kernel.
MatrixXd by_definition(const VectorXd& angles)
{
    const double widest = 1.0;
    const Index m = static_cast<Index>(angles.size());
    MatrixXd g(m, m), c = MatrixXd::Zero(m, m), s = MatrixXd::Identity(m, m), p = MatrixXd::Zero(m, m);
    for (Index a = 0; a < m; ++a) {
        for (Index b = 0; b < m; ++b) g(a, b) = clausen_cosine_3(angles[a] - angles[b]) / pi;
        const auto gap = [&](Index e) {
            return e + 1 < m ? angles[e + 1] - angles[e] : angles[0] + 2 * pi - angles[e];
        };
        const Index before = (a + m - 1) % m, after = (a + 1) % m;
        c(a, before) += 1.0 / gap(before);
        c(a, a) -= 1.0 / gap(before) + 1.0 / gap(a);
        c(a, after) += 1.0 / gap(a);
        // -(d- d+ / 12) u'', u'' = 2 ((u+ - u) / d+ - (u - u-) / d-) / (d- + d+)
        const double mean = 0.5 * (gap(before) + gap(a));
        const double share = std::min(1.0, widest / mean) * gap(before) * gap(a) / 6.0 / (2.0 * mean);
        s(a, after) -= share / gap(a);
        s(a, a) += share * (1.0 / gap(a) + 1.0 / gap(before));
        s(a, before) -= share / gap(before);
        VectorXd jump = VectorXd::Zero(m);
        jump[a] = 1.0;
        jump[after] = -1.0;
        p += std::min(gap(a), widest) / 6.0 * jump * jump.transpose();
    }
    return s.transpose() * (c * g * c.transpose()) * s - p;
}

}  // namespace

TEST(ClausenCosine, equals_its_series_and_its_value_at_pi)
{
    EXPECT_NEAR(clausen_cosine_3(pi), -0.75 * 1.2020569031595942854, 1e-14);
    for (const double t : {0.1, 1.0, 2.5, 4.0, -1.3, 7.0}) {
        double series = 0.0;
        for (int j = 20000; j >= 1; --j) series += std::cos(j * t) / (static_cast<double>(j) * j * j);
        EXPECT_NEAR(clausen_cosine_3(t), series, 1e-11) << t;
    }
}

TEST(DiskDirichletToNeumann, equals_its_definition)
{
    for (const Index m : {3, 4, 7, 40, 200})
        for (const double spread : {1.0, 4.0, 100.0}) {
            const VectorXd angles = uneven_angles(m, spread);
            const MatrixXd expected = by_definition(angles);
            EXPECT_LT((disk_dirichlet_to_neumann(angles) - expected).cwiseAbs().maxCoeff(), 2e-7 * expected.norm())
                << m << " nodes, spread " << spread;
        }
}

TEST(DiskDirichletToNeumann, has_the_energy_of_harmonic_polynomials_on_the_polygon)
{
    // Re z^k has the energy k pi over the disk; over the m segments between circle and chords, of height d^2 / 12 in
    // the mean, it has k^2 d^2 / 6 pi. The rest is of a higher order than that.
    for (const int k : {1, 2, 5}) {
        double last = 0.0;
        for (const Index m : {200, 400, 800}) {
            const VectorXd angles = equal_angles(m);
            const VectorXd u = (k * angles.array()).cos();
            const double d = 2.0 * pi / static_cast<double>(m), polygon = k * pi * (1.0 - k * d * d / 6.0);
            const double error = std::abs(u.dot(disk_dirichlet_to_neumann(angles) * u) / polygon - 1.0);
            if (m > 200) {
                EXPECT_LT(error, last / 6.0) << "k " << k << ", m " << m;
            }
            last = error;
        }
        EXPECT_LT(last, 1e-8 * k * k * k);
    }
}

TEST(DiskDirichletToNeumann, of_few_nodes_is_that_of_the_polygon)
{
    // A linear function has the polygon's area as its energy.
    for (const Index m : {3, 4, 5, 6, 7, 9, 12}) {
        const VectorXd angles = equal_angles(m);
        const VectorXd u = angles.array().cos();
        const double area = 0.5 * m * std::sin(2.0 * pi / m);
        EXPECT_NEAR(u.dot(disk_dirichlet_to_neumann(angles) * u), area, 0.07 * area) << m;
    }
}

TEST(DiskDirichletToNeumann, stays_positive_where_arcs_are_wide)
{
    for (const Index m : {2, 3, 4, 7, 12, 30}) {
        VectorXd angles = VectorXd::LinSpaced(m, 0.0, 1e-3);
        angles.tail(m / 2).array() += pi;  // two bunches, the two arcs between them the widest there can be
        VectorXd u = VectorXd::Ones(m);
        u.tail(m / 2).setZero();
        EXPECT_GT(u.dot(disk_dirichlet_to_neumann(angles) * u), 0.2) << m;
    }
}

TEST(DiskDirichletToNeumann, is_symmetric_semidefinite_and_kills_constants)
{
    const MatrixXd t = disk_dirichlet_to_neumann(uneven_angles(120, 1000.0));
    EXPECT_EQ((t - t.transpose()).cwiseAbs().maxCoeff(), 0.0);
    EXPECT_LT((t * VectorXd::Ones(120)).cwiseAbs().maxCoeff(), 1e-9);
    for (int trial = 0; trial < 10; ++trial) {
        const VectorXd u = VectorXd::Random(120);
        EXPECT_GT(u.dot(t * u), 0.0);
    }
}

TEST(DiskDirichletToNeumann, survives_angles_that_nearly_coincide)
{
    VectorXd angles = equal_angles(50);
    angles[20] = angles[19] + 1e-9;
    const MatrixXd t = disk_dirichlet_to_neumann(angles);
    ASSERT_TRUE(t.allFinite());
    // A function that does not tell the two nodes apart does not see them.
    const VectorXd u = angles.array().cos();
    const double without = u.dot(disk_dirichlet_to_neumann(equal_angles(50)) * u);
    EXPECT_NEAR(u.dot(t * u), pi, 2.0 * std::abs(without - pi) + 0.02);
}
