#include "circle_domain.h"
#include "circle_samples.h"
#include "core/errors.h"
#include "shape/conformal_module.h"
#include "shape/loop_matching.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

using namespace koebe;
using namespace koebe::test;

namespace {

/// The inner loops in another order, fixed by the seed.
std::vector<int> shuffle(std::size_t loops, unsigned seed)
{
    std::vector<int> order(loops);
    std::iota(order.begin(), order.end(), 0);
    std::mt19937 random(seed);
    std::shuffle(order.begin() + 1, order.end(), random);
    return order;
}

/// The domain with centres and radii moved by up to so much.
std::vector<Circle> disturbed(std::vector<Circle> circles, double by)
{
    std::mt19937 random(9);
    std::uniform_real_distribution<double> noise(-by, by);
    for (std::size_t k = 1; k < circles.size(); ++k) {
        circles[k].center += Complex(noise(random), noise(random));
        circles[k].radius += noise(random);
    }
    return circles;
}

}  // namespace

TEST(LoopMatching, finds_the_same_shape_under_other_numbers_and_a_moebius_map)
{
    for (const int holes : {0, 1, 2, 3, 7, 8, 25, 100}) {
        const std::vector<Circle> circles = random_domain(holes, 11);
        const std::vector<int> order = shuffle(circles.size(), 5);
        const LoopMatch match = match_loops(circles, image(some_maps[1], reordered(circles, order)));
        EXPECT_LT(match.distance, 1e-10) << holes;
        for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(match.order_a[i], order[match.order_b[i]]) << holes;
        EXPECT_EQ(match.exhaustive, holes <= 7);
    }
}

TEST(LoopMatching, finds_the_loops_of_a_shape_that_has_changed_a_little)
{
    for (const int holes : {4, 7, 12, 30}) {
        const std::vector<Circle> circles = random_domain(holes, 21);
        const std::vector<int> order = shuffle(circles.size(), 6);
        const LoopMatch match = match_loops(circles, reordered(disturbed(circles, 2e-3), order));
        for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(match.order_a[i], order[match.order_b[i]]) << holes;
    }
}

TEST(LoopMatching, finds_five_hundred_loops_of_a_shape_that_has_changed_a_little)
{
    const std::vector<Circle> circles = random_domain(500, 13);
    const std::vector<int> order = shuffle(circles.size(), 4);
    const LoopMatch match = match_loops(circles, image(some_maps[2], reordered(disturbed(circles, 1e-4), order)));
    int wrong = 0;
    for (std::size_t i = 0; i < order.size(); ++i) wrong += match.order_a[i] != order[match.order_b[i]];
    EXPECT_EQ(wrong, 0);
    EXPECT_LT(match.distance, 0.1);
    EXPECT_FALSE(match.exhaustive);
}

TEST(LoopMatching, slow_finds_another_outer_loop_among_many)
{
    const std::vector<Circle> circles = random_domain(40, 8);
    std::vector<int> order = shuffle(circles.size(), 3);
    std::swap(order[0], order[24]);
    const std::vector<Circle> other = normalized_circles(circles, order);
    EXPECT_LT(match_loops(circles, other, true).distance, 1e-8);
}

TEST(LoopMatching, can_be_cancelled)
{
    CancelToken token;
    token.cancel();
    for (const int holes : {3, 20}) {
        const std::vector<Circle> circles = random_domain(holes, 1);
        EXPECT_THROW(match_loops(circles, circles, false, ExecutionContext({}, token)), Cancelled) << holes;
        EXPECT_THROW(match_loops(circles, circles, true, ExecutionContext({}, token)), Cancelled) << holes;
    }
}

TEST(LoopMatching, distance_is_symmetric_and_that_of_the_modules_in_its_orders)
{
    for (const int holes : {3, 5, 9}) {
        const std::vector<Circle> a = random_domain(holes, 1), b = random_domain(holes, 2);
        const LoopMatch match = match_loops(a, b);
        EXPECT_NEAR(match.distance, match_loops(b, a).distance, 1e-12);
        EXPECT_NEAR(match.distance, (conformal_module(a, match.order_a) - conformal_module(b, match.order_b)).norm(),
                    1e-12);
        EXPECT_GT(match.distance, 0.05);
    }
}

TEST(LoopMatching, has_the_margin_to_the_next_best_match)
{
    // Twice two equal holes, turned by half: two matches fit alike, until one hole is larger.
    std::vector<Circle> circles{{}, {{0.5, 0.2}, 0.1}, {{-0.5, -0.2}, 0.1}, {{0.1, -0.5}, 0.15}, {{-0.1, 0.5}, 0.15}};
    EXPECT_LT(match_loops(circles, disturbed(circles, 1e-9)).margin, 0.5);
    circles[1].radius = 0.2;
    EXPECT_GT(match_loops(circles, disturbed(circles, 1e-3)).margin, 0.9);
    EXPECT_EQ(match_loops({{}, {{0.2, 0.1}, 0.3}}, {{}, {{0.0, 0.0}, 0.3}}).margin, 1.0);
    // More loops than all matches are tried for: a ring of equal holes can be turned.
    std::vector<Circle> ring{{}};
    for (int k = 0; k < 9; ++k) ring.push_back({std::polar(0.6, 2.0 * std::numbers::pi * k / 9), 0.1});
    const LoopMatch turned = match_loops(ring, ring);
    EXPECT_LT(turned.distance, 1e-9);
    EXPECT_FALSE(turned.exhaustive);
    EXPECT_LT(turned.margin, 0.3);
    EXPECT_GT(match_loops(random_domain(9, 1), disturbed(random_domain(9, 1), 1e-3)).margin, 0.8);
}

TEST(LoopMatching, tells_a_shape_from_its_mirror_image)
{
    EXPECT_GT(match_loops(five_circles(), mirrored(five_circles())).distance, 0.02);
    // but not one that is its own mirror image
    const std::vector<Circle> face{{}, {{-0.4, 0.3}, 0.2}, {{0.4, 0.3}, 0.2}, {{0.0, -0.4}, 0.25}};
    EXPECT_LT(match_loops(face, mirrored(face)).distance, 1e-12);
}

TEST(LoopMatching, finds_another_outer_loop_only_if_asked)
{
    const std::vector<Circle> circles = random_domain(5, 8);
    const std::vector<Circle> other = normalized_circles(circles, {4, 2, 0, 1, 3, 5});
    EXPECT_GT(match_loops(circles, other).distance, 0.05);
    const LoopMatch match = match_loops(circles, other, true);
    EXPECT_LT(match.distance, 1e-10);
    EXPECT_LT(match_loops(other, circles, true).distance, 1e-10);
    EXPECT_EQ(match.order_b[0] == 0, match.order_a[0] != 0);
}

TEST(LoopMatching, refuses_different_numbers_of_loops)
{
    for (const int holes : {2, 4, 9}) {
        try {
            match_loops(random_domain(3, 1), random_domain(holes, 1));
            ADD_FAILURE() << holes;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find("cannot be compared"), std::string::npos) << error.what();
        }
    }
}
