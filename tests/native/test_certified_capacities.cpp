#include "certified/bisected_surface.h"
#include "certified/capacities.h"
#include "certified/interval.h"
#include "core/connectivity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace koebe;

namespace {

/// A number to 113 bits, to compare with.
using Exact = __float128;

bool holds(const Interval& interval, Exact number)
{
    return Exact(interval.lower) <= number && number <= Exact(interval.upper);
}

/// A square of two triangles with a fold, side 1.
std::pair<Vertices, Triangles> square()
{
    Vertices vertices(4, 3);
    vertices << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 1;
    Triangles triangles(2, 3);
    triangles << 0, 1, 2, 0, 2, 3;
    return {vertices, triangles};
}

}  // namespace

TEST(CertifiedCapacities, intervals_hold_the_exact_results)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<double> number(-2.0, 2.0);
    std::uniform_int_distribution<int> exponent(-15, 15);
    for (int i = 0; i < 100000; ++i) {
        const double a = std::ldexp(number(random), i % 2 ? exponent(random) : 0);
        const double b = std::ldexp(number(random), i % 3 ? exponent(random) : 0);
        EXPECT_TRUE(holds(Interval(a) + b, Exact(a) + Exact(b)));
        EXPECT_TRUE(holds(Interval(a) - b, Exact(a) - Exact(b)));
        EXPECT_TRUE(holds(Interval(a) * b, Exact(a) * Exact(b)));
        EXPECT_TRUE(holds(squared(a), Exact(a) * Exact(a)));
        const Interval quotient = Interval(a) / std::abs(b);
        EXPECT_TRUE(Exact(quotient.lower) * std::abs(b) <= a && Exact(a) <= Exact(quotient.upper) * std::abs(b));
        const Interval root = square_root(std::abs(a));
        EXPECT_TRUE(holds({0.0, std::abs(a)}, Exact(root.lower) * root.lower));
        EXPECT_GE(Exact(root.upper) * root.upper, Exact(std::abs(a)));
        const double c = number(random), d = number(random);
        const Interval first(std::min(a, b), std::max(a, b)), second(std::min(c, d), std::max(c, d));
        for (const double x : {a, b}) {
            EXPECT_TRUE(holds(squared(first), Exact(x) * Exact(x)));
            for (const double y : {c, d}) {
                EXPECT_TRUE(holds(first * second, Exact(x) * Exact(y)));
                EXPECT_TRUE(holds(first - second, Exact(x) - Exact(y)));
            }
        }
    }
    const double least = std::numeric_limits<double>::denorm_min(), most = std::numeric_limits<double>::max();
    EXPECT_LT((Interval(least) * 0.25).lower, 0.0 + least);
    EXPECT_GE((Interval(least) * 0.25).upper, least);
    EXPECT_FALSE(std::isfinite((Interval(most) * 2.0).lower) && std::isfinite((Interval(most) * 2.0).upper));
}

TEST(CertifiedCapacities, faces_stay_on_the_surface_and_their_energies_add_up)
{
    const auto [vertices, triangles] = square();
    BisectedSurface surface(vertices, analyze_surface(triangles, 4));
    std::mt19937 random(2);
    for (int level = 0; level < 12; ++level) {
        // A covector with length 1 on each face: du of the distance from an edge of the square.
        double sum = 0.0, area = 0.0;
        const EdgeLengths lengths = surface.lengths();
        for (Index f = 0; f < surface.face_count(); ++f) {
            const double a = lengths(f, 0), b = lengths(f, 2), c = lengths(f, 1);
            const double cosine = (a * a + b * b - c * c) / (2.0 * a * b);
            // The direction of edge 0: integrals |e1| and |e2| cos.
            const Interval energy = surface.energy(f, a, b * cosine);
            sum += 0.5 * (energy.lower + energy.upper);
            area += triangle_area(a, b, c);
            EXPECT_LT(energy.width(), 1e-13 * energy.upper);
        }
        EXPECT_NEAR(sum / area, 1.0, 1e-12);
        const auto rim = static_cast<Index>(std::ranges::count(surface.twin(), no_twin));
        EXPECT_EQ(surface.vertex_count() - (3 * surface.face_count() + rim) / 2 + surface.face_count(), 1);
        std::vector<char> marked(surface.face_count(), 0);
        for (char& mark : marked) mark = random() % 4 == 0;
        surface.refine(marked);
    }
    EXPECT_GT(surface.face_count(), 1000);
}

TEST(CertifiedCapacities, condensers_are_singles_and_pairs_up_to_exchange)
{
    EXPECT_EQ(loop_condensers(1).size(), 0u);
    EXPECT_EQ(loop_condensers(2).size(), 1u);
    EXPECT_EQ(loop_condensers(3).size(), 3u);
    EXPECT_EQ(loop_condensers(4).size(), 7u);
    EXPECT_EQ(loop_condensers(6).size(), 21u);
}
