#include "circle_domain.h"
#include "circle_samples.h"
#include "core/errors.h"
#include "shape/separation_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace koebe;
using namespace koebe::test;

namespace {

std::vector<int> numbers(std::size_t count)
{
    std::vector<int> all(count);
    std::iota(all.begin(), all.end(), 0);
    return all;
}

}  // namespace

TEST(SeparationDistance, of_a_ring_is_the_logarithm_of_its_radii)
{
    const std::vector<Circle> ring{Circle{}, {0.0, 0.2}}, other{Circle{}, {0.0, 0.5}};
    EXPECT_NEAR(conformal_separations(ring)(0, 1), std::log(5.0), 1e-14);
    EXPECT_NEAR(match_separations(ring, other).distance, std::log(2.5), 1e-14);
}

TEST(SeparationDistance, does_not_see_numbers_moebius_maps_and_mirrors)
{
    for (const int holes : {0, 1, 2, 3, 6, 9, 14}) {
        const std::vector<Circle> circles = random_domain(holes, 11);
        std::vector<int> order = numbers(circles.size());
        std::reverse(order.begin() + 1, order.end());
        const std::vector<Circle> other = image(some_maps[1], reordered(circles, order));
        const SeparationMatch found = match_separations(circles, other);
        EXPECT_LT(found.distance, 1e-9) << holes;
        if (holes > 2) {
            for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(order[found.match[i]], static_cast<int>(i));
        }
        EXPECT_LT(match_separations(circles, mirrored(other)).distance, 1e-9) << holes;
    }
}

TEST(SeparationDistance, is_the_least_of_all_correspondences)
{
    for (unsigned seed = 0; seed < 5; ++seed) {
        const std::vector<Circle> a = random_domain(5, seed), b = random_domain(5, seed + 50);
        double least = 1e300, least_any = 1e300;
        std::vector<int> match = numbers(a.size());
        do {
            const double distance = separation_distance(a, b, match);
            least_any = std::min(least_any, distance);
            if (match[0] == 0) least = std::min(least, distance);
        } while (std::ranges::next_permutation(match).found);
        EXPECT_NEAR(match_separations(a, b).distance, least, 1e-13);
        EXPECT_NEAR(match_separations(a, b, true).distance, least_any, 1e-13);
        const SeparationMatch found = match_separations(a, b);
        EXPECT_NEAR(separation_distance(a, b, found.match), found.distance, 1e-13);
    }
}

TEST(SeparationDistance, is_symmetric_and_obeys_the_triangle_inequality)
{
    std::vector<std::vector<Circle>> shapes;
    for (unsigned seed = 0; seed < 12; ++seed) shapes.push_back(random_domain(4, seed));
    MatrixXd distance(12, 12);
    for (int i = 0; i < 12; ++i)
        for (int j = 0; j < 12; ++j) distance(i, j) = match_separations(shapes[i], shapes[j]).distance;
    EXPECT_LT((distance - distance.transpose()).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_LT(distance.diagonal().maxCoeff(), 1e-13);
    for (int i = 0; i < 12; ++i)
        for (int j = 0; j < 12; ++j)
            for (int k = 0; k < 12; ++k) EXPECT_LE(distance(i, k), distance(i, j) + distance(j, k) + 1e-13);
}

TEST(SeparationDistance, refuses_what_has_none)
{
    const std::vector<Circle> circles = random_domain(3, 1);
    EXPECT_THROW(match_separations(circles, random_domain(4, 1)), InputError);
    EXPECT_THROW(separation_distance(circles, circles, {0, 1, 1, 3}), InputError);
    EXPECT_THROW(conformal_separations({Circle{}, {0.0, 0.5}, {0.2, 0.5}}), InputError);
}
