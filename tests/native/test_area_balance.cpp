#include "balance/area_balance.h"
#include "circle_domain.h"
#include "circles/circle_fit.h"
#include "core/errors.h"
#include "pipeline/outer_loop.h"
#include "pipeline/uniformize.h"
#include "planar_map.h"
#include "surface/importance.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace koebe;
using namespace koebe::test;

TEST(AreaBalance, undoes_an_automorphism_of_the_flat_disk)
{
    const CircleDomain domain = make_circle_domain({Circle{}}, 4000);
    const Vertices flat = lift(domain.points, Lift::plane);
    for (const Complex a : {Complex(0.3, -0.2), Complex(-0.7, 0.4), Complex(0.0, 0.9)}) {
        const VectorXcd moved = Moebius{a, std::polar(1.0, 0.7)}(domain.points);
        double distortion = 0.0;
        const Moebius balance =
            least_area_distortion(face_scales(flat, domain.triangles, planar(moved), 20000), distortion);
        EXPECT_LT((balance(moved).cwiseAbs() - domain.points.cwiseAbs()).cwiseAbs().maxCoeff(), 2e-3) << a;
        EXPECT_LT(distortion, 1e-2) << a;  // a face of 4,000 is not a point
    }
}

TEST(AreaBalance, finds_the_outer_loop_of_a_flat_domain_again)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 4000);
    const Vertices flat = lift(domain.points, Lift::plane);
    const auto chosen = [&](const VectorXcd& points, const std::vector<Circle>& circles) {
        return balanced_outer_loop(face_scales(flat, domain.triangles, planar(points), 2000), circles, {0, 1, 2, 3, 4});
    };
    EXPECT_EQ(chosen(domain.points, domain.circles), 0);

    // Loop 2 turned outside: it is the unit circle now, and the old outer loop a hole.
    const Circle hole = domain.circles[2];
    const VectorXcd turned = (hole.radius / (domain.points.array() - hole.center)).matrix();
    std::vector<Circle> circles{Circle{}};
    for (const int k : {0, 1, 3, 4}) {
        VectorXcd loop(domain.loops[k].size());
        for (Eigen::Index b = 0; b < loop.size(); ++b) loop[b] = turned[domain.loops[k][b]];
        circles.push_back(fit_circle_least_squares(loop));
    }
    EXPECT_EQ(chosen(turned, circles), 1);
}

TEST(AreaBalance, lowers_the_area_distortion_and_keeps_circles_and_angles)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 4000);
    const Vertices surface = lift(Moebius{{0.5, 0.3}, {1.0, 0.0}}(domain.points), Lift::polynomial);
    UniformizeOptions options;
    options.outer = OuterLoop::longest;
    ExecutionContext context;
    const UniformizeResult plain = uniformize(surface, domain.triangles, options, context);
    options.balance = Balance::area;
    const UniformizeResult balanced = uniformize(surface, domain.triangles, options, context);
    ASSERT_TRUE(balanced.unbalanced_area);
    EXPECT_FALSE(plain.unbalanced_area);
    EXPECT_DOUBLE_EQ(balanced.unbalanced_area->log_sd, plain.distortion.area.log_sd);
    EXPECT_LT(balanced.distortion.area.log_sd, plain.distortion.area.log_sd);
    EXPECT_NEAR(balanced.distortion.angle_error_deg.mean, plain.distortion.angle_error_deg.mean, 0.05);
    EXPECT_TRUE(balanced.distortion.flipped.empty());
    for (std::size_t i = 0; i < 5; ++i) {
        const LoopReport& loop = balanced.loops[i];
        for (const Index v : loop.vertices)
            EXPECT_NEAR(std::abs(Complex(balanced.uv(v, 0), balanced.uv(v, 1)) - loop.circle.center),
                        loop.circle.radius, 1e-13);
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_NEAR(inversive_distance(balanced.loops[i].circle, balanced.loops[j].circle) /
                            inversive_distance(plain.loops[i].circle, plain.loops[j].circle),
                        1.0, 1e-9);
    }
}

/// Where the surface is to count for as much larger as an automorphism makes it, that is the even map.
TEST(AreaBalance, gives_what_is_important_the_room_that_it_asks_for)
{
    const CircleDomain domain = make_circle_domain({Circle{}}, 4000);
    const Vertices flat = lift(domain.points, Lift::plane);
    for (const Complex a : {Complex(0.3, 0.0), Complex(-0.1, 0.25)}) {
        const VectorXd scale = (1.0 - std::norm(a)) / (1.0 - std::conj(a) * domain.points.array()).abs2();
        const VectorXd importance = (scale.array() / scale.minCoeff()).log() / std::log(most_important);
        ASSERT_LE(importance.maxCoeff(), 1.0);
        double distortion = 0.0;
        const Moebius balance = least_area_distortion(
            face_scales(flat, domain.triangles, planar(domain.points), 20000, importance), distortion);
        EXPECT_LT(std::abs(balance.a - a), 2e-3) << a;
        EXPECT_LT(distortion, 1e-2) << a;
    }
}

TEST(AreaBalance, equal_importance_changes_no_bit)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 2000);
    const Vertices surface = lift(domain.points, Lift::polynomial);
    UniformizeOptions options;
    options.balance = Balance::area;
    const UniformizeResult plain = uniformize(surface, domain.triangles, options);
    options.importance.assign(static_cast<std::size_t>(surface.rows()), 0.7);
    EXPECT_EQ(uniformize(surface, domain.triangles, options).uv, plain.uv);
    options.importance.back() = 2.0;
    EXPECT_THROW(uniformize(surface, domain.triangles, options), InputError);
    options.importance.assign(3, 0.5);
    EXPECT_THROW(uniformize(surface, domain.triangles, options), InputError);
    options = {};
    options.importance.assign(static_cast<std::size_t>(surface.rows()), 0.7);
    EXPECT_THROW(uniformize(surface, domain.triangles, options), InputError);  // there is no balance
}
