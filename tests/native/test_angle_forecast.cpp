#include "circle_domain.h"
#include "iteration/angle_forecast.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace koebe;
using namespace koebe::test;

namespace {

/// Shapes and angles that follow one parameter.
struct Motion {
    VectorXd shape = VectorXd::Random(200), velocity = VectorXd::Random(200), bend = VectorXd::Random(200);

    VectorXd shape_at(double t) const { return shape + t * velocity + 0.01 * t * t * bend; }

    static std::vector<VectorXd> angles_at(double t)
    {
        const VectorXd even = VectorXd::LinSpaced(40, 0.0, 2.0 * std::numbers::pi * 39.0 / 40.0);
        return {even.array() + 0.05 * t * even.array().sin(), even.array() - 0.03 * t * (2.0 * even.array()).cos()};
    }
};

double distance(const std::vector<VectorXd>& a, const std::vector<VectorXd>& b)
{
    EXPECT_EQ(a.size(), b.size());
    double most = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, (a[k] - b[k]).cwiseAbs().maxCoeff());
    return most;
}

}  // namespace

TEST(AngleForecast, follows_a_motion)
{
    std::srand(1);
    const Motion motion;
    AngleForecast forecast;
    EXPECT_TRUE(forecast.angles_for(motion.shape_at(0.0)).empty());
    forecast.add(motion.shape_at(0.0), Motion::angles_at(0.0));
    EXPECT_EQ(distance(forecast.angles_for(motion.shape_at(0.5)), Motion::angles_at(0.0)), 0.0);
    forecast.add(motion.shape_at(0.5), Motion::angles_at(0.5));
    EXPECT_LT(distance(forecast.angles_for(motion.shape_at(1.0)), Motion::angles_at(1.0)), 1e-3);
    forecast.add(motion.shape_at(1.0), Motion::angles_at(1.0));
    EXPECT_LT(distance(forecast.angles_for(motion.shape_at(1.5)), Motion::angles_at(1.5)), 1e-12);
    EXPECT_LT(distance(forecast.angles_for(motion.shape_at(0.0)), Motion::angles_at(0.0)), 1e-12);  // comes back
}

TEST(AngleForecast, an_angle_may_have_gone_round)
{
    std::srand(1);
    const Motion motion;
    AngleForecast forecast;
    forecast.add(motion.shape_at(0.0), Motion::angles_at(0.0));
    std::vector<VectorXd> turned = Motion::angles_at(0.5);
    turned[1].array() -= 2.0 * std::numbers::pi;
    forecast.add(motion.shape_at(0.5), turned);
    std::vector<VectorXd> expected = Motion::angles_at(1.0);
    expected[1].array() -= 2.0 * std::numbers::pi;
    EXPECT_LT(distance(forecast.angles_for(motion.shape_at(1.0)), expected), 1e-3);
}

TEST(AngleForecast, what_is_no_combination_begins_at_the_last_angles)
{
    std::srand(1);
    const Motion motion;
    AngleForecast forecast;
    for (const double t : {0.0, 0.5, 0.5, 1.0}) forecast.add(motion.shape_at(t), Motion::angles_at(t));
    const VectorXd elsewhere = motion.shape_at(1.0) + VectorXd::Random(200);
    EXPECT_EQ(distance(forecast.angles_for(elsewhere), Motion::angles_at(1.0)), 0.0);
    // So far on that vertices of a loop would pass each other.
    EXPECT_EQ(distance(forecast.angles_for(motion.shape_at(40.0)), Motion::angles_at(1.0)), 0.0);
    EXPECT_EQ(distance(forecast.angles_for(motion.shape_at(1.0)), Motion::angles_at(1.0)), 0.0);
}

TEST(AngleForecast, a_shape_has_no_place_and_no_size)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 1000);
    const Vertices here = lift(domain.points, Lift::enneper);
    Vertices there = 7.0 * here;
    there.col(1) *= -1.0;
    there.col(2).array() += 3.0;
    const VectorXd shape = AngleForecast::shape_of(here, domain.triangles);
    EXPECT_LT((AngleForecast::shape_of(there, domain.triangles) - shape).norm(), 1e-10 * shape.norm());
    there.col(0) *= 1.1;
    EXPECT_GT((AngleForecast::shape_of(there, domain.triangles) - shape).norm(), 1e-2 * shape.norm());
    EXPECT_TRUE(AngleForecast::shape_of(Vertices::Zero(here.rows(), 3), domain.triangles).allFinite());
}
