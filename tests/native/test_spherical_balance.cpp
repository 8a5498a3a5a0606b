#include "sphere/spherical_balance.h"
#include "sphere/spherical_points.h"

#include <gtest/gtest.h>

#include <cmath>

namespace koebe {
namespace {

struct WeightedPoints {
    VectorXcd z;
    VectorXd weights;
};

/// Points on a spiral far from balanced, in more than one piece of the sums.
WeightedPoints spiral(double far)
{
    constexpr Eigen::Index count = 40000;
    WeightedPoints points{VectorXcd(count), VectorXd(count)};
    for (Eigen::Index v = 0; v < count; ++v) {
        const double t = static_cast<double>(v) / count;
        points.z[v] = Complex(3.0, 1.0) + std::polar(0.1 + t, 40.0 * t);
        points.weights[v] = 1.0 + t;
    }
    points.z[7] = far;
    return points;
}

TEST(SphericalBalance, the_weighted_mean_of_the_points_is_the_centre)
{
    for (const double far : {2.0, 1e150}) {
        const auto [z, weights] = spiral(far);
        const SphericalBalance balance = balance_on_sphere(z, weights);
        const Vertices points = on_sphere(balance.move(z));
        EXPECT_TRUE(balance.balanced);
        EXPECT_LT((weights.transpose() * points).norm() / weights.sum(), 1e-13);
    }
}

TEST(SphericalBalance, the_balanced_map_is_the_least_uneven_one)
{
    for (const double far : {2.0, 1e200}) {
        const auto [z, weights] = spiral(far);
        const PlaneSimilarity least = balance_on_sphere(z, weights).move;
        const double at_least = spherical_unevenness(z, weights, least);
        ASSERT_TRUE(std::isfinite(at_least));
        for (const double step : {-0.01, 0.01}) {
            EXPECT_LT(at_least, spherical_unevenness(z, weights, {least.shift + step, least.scale}));
            EXPECT_LT(at_least, spherical_unevenness(z, weights, {least.shift + Complex(0.0, step), least.scale}));
            EXPECT_LT(at_least, spherical_unevenness(z, weights, {least.shift, least.scale * std::exp(step)}));
        }
    }
}

TEST(SphericalBalance, half_of_the_weight_in_a_point_has_no_balance)
{
    auto [z, weights] = spiral(2.0);
    weights[9] = 2.0 * weights.sum();
    EXPECT_FALSE(balance_on_sphere(z, weights).balanced);
}

}  // namespace
}  // namespace koebe
