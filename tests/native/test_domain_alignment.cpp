#include "circle_domain.h"
#include "circle_samples.h"
#include "core/errors.h"
#include "shape/domain_alignment.h"

#include <gtest/gtest.h>

using namespace koebe;
using namespace koebe::test;

namespace {

double sum_of_squares(const std::vector<Circle>& source, const std::vector<Circle>& target, const Moebius& map)
{
    double sum = 0.0;
    for (std::size_t k = 1; k < source.size(); ++k) {
        const Circle placed = map(target[k]);
        sum += std::norm(placed.center - source[k].center) + std::pow(placed.radius - source[k].radius, 2);
    }
    return sum;
}

}  // namespace

TEST(DomainAlignment, recovers_the_moebius_map_between_two_pictures_of_one_shape)
{
    for (const int holes : {2, 3, 6, 20})
        for (const Moebius& map : some_maps) {
            const std::vector<Circle> source = random_domain(holes, 4);
            const DomainAlignment found = align_domains(source, image(map, source));
            EXPECT_TRUE(found.converged);
            EXPECT_LT(found.residual, 1e-12);
            EXPECT_LT(std::abs((found.map * map).a), 1e-9);
            EXPECT_LT(std::abs((found.map * map).turn - 1.0), 1e-9);
            for (std::size_t k = 0; k < source.size(); ++k) EXPECT_EQ(found.match[k], static_cast<int>(k));
        }
}

TEST(DomainAlignment, no_nearby_automorphism_fits_better)
{
    const std::vector<Circle> source = five_circles();
    const std::vector<Circle> target{
        {}, {{0.4, 0.3}, 0.2}, {{-0.35, 0.3}, 0.2}, {{0.0, -0.5}, 0.25}, {{0.5, -0.3}, 0.1}};
    const DomainAlignment found = align_domains(source, target, {0, 1, 2, 3, 4});
    const double least = sum_of_squares(source, target, found.map);
    EXPECT_TRUE(found.converged);
    EXPECT_NEAR(found.residual, std::sqrt(least / 4.0), 1e-12);
    EXPECT_GE(found.largest, found.residual);
    EXPECT_LT(found.iterations, 20);
    EXPECT_LT(least, sum_of_squares(source, target, {}));
    for (const double step : {1e-3, -1e-3}) {
        EXPECT_GT(sum_of_squares(source, target, Moebius{{step, 0.0}, {1.0, 0.0}} * found.map), least);
        EXPECT_GT(sum_of_squares(source, target, Moebius{{0.0, step}, {1.0, 0.0}} * found.map), least);
        EXPECT_GT(sum_of_squares(source, target, Moebius{{}, std::polar(1.0, step)} * found.map), least);
    }
}

TEST(DomainAlignment, with_one_hole_lays_it_on_the_other_and_leaves_the_rotation)
{
    const std::vector<Circle> source{{}, {{0.3, 0.2}, 0.25}};
    const DomainAlignment found = align_domains(source, image(some_maps[2], source));
    EXPECT_LT(found.residual, 1e-12);
    const DomainAlignment same = align_domains(source, source);
    EXPECT_LT(std::abs(same.map.a), 1e-9);
    EXPECT_LT(std::abs(same.map.turn - 1.0), 1e-9);
}

TEST(DomainAlignment, without_a_hole_is_the_identity)
{
    const DomainAlignment found = align_domains({Circle{}}, {Circle{}});
    EXPECT_EQ(found.map.a, Complex(0.0));
    EXPECT_EQ(found.residual, 0.0);
    EXPECT_EQ(found.match, std::vector<int>{0});
}

TEST(DomainAlignment, refuses_a_match_that_moves_the_outer_loop)
{
    const std::vector<Circle> circles = random_domain(2, 1);
    EXPECT_THROW(align_domains(circles, circles, {1, 0, 2}), InputError);
    EXPECT_THROW(align_domains(circles, circles, {0, 1, 1}), InputError);
    EXPECT_THROW(align_domains(circles, circles, {0, 1}), InputError);
}
