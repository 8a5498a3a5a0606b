#include "circles/circle_fit.h"
#include "circles/moebius.h"

#include <gtest/gtest.h>

using namespace koebe;

namespace {

const Moebius samples[] = {
    {{0.0, 0.0}, std::polar(1.0, 1.0)}, {{0.3, -0.5}, {1.0, 0.0}}, {{-0.7, 0.6}, std::polar(1.0, -2.0)}};
const Circle circles[] = {{{0.2, 0.1}, 0.3}, {{-0.5, 0.4}, 0.2}, {{0.0, 0.0}, 0.5}, {{0.6, -0.3}, 1e-9}};

}  // namespace

TEST(Moebius, keeps_the_unit_circle_and_its_inverse_undoes_it)
{
    for (const Moebius& m : samples)
        for (int i = 0; i < 12; ++i) {
            const Complex rim = std::polar(1.0, 0.5 * i), inside = std::polar(0.08 * i, 1.7 * i);
            EXPECT_NEAR(std::abs(m(rim)), 1.0, 1e-14);
            EXPECT_LT(std::abs(m.inverse()(m(inside)) - inside), 1e-14);
            EXPECT_LT(std::abs(m(m.inverse()(inside)) - inside), 1e-14);
        }
}

TEST(Moebius, sends_circles_to_circles)
{
    for (const Moebius& m : samples)
        for (const Circle& circle : circles) {
            const Circle image = m(circle);
            for (int i = 0; i < 12; ++i)
                EXPECT_NEAR(std::abs(m(circle.center + std::polar(circle.radius, 0.5 * i)) - image.center),
                            image.radius, 1e-14);
        }
}

TEST(Moebius, keeps_inversive_distances)
{
    for (const Moebius& m : samples)
        EXPECT_NEAR(inversive_distance(m(circles[0]), m(circles[1])) / inversive_distance(circles[0], circles[1]), 1.0,
                    1e-12);
}

TEST(Moebius, centres_a_circle)
{
    for (const Circle& circle : circles) {
        const Circle image = center_circle(circle)(circle);
        EXPECT_LT(std::abs(image.center), 1e-14);
        EXPECT_NEAR(inversive_distance(image, Circle{}) / inversive_distance(circle, Circle{}), 1.0, 1e-7);
    }
}
