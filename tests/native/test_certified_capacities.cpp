#include "certified/bisected_surface.h"
#include "certified/capacities.h"
#include "certified/interval.h"
#include "core/errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace koebe;

namespace {

CapacityReport enclose(const Vertices& vertices, const Triangles& triangles, const CapacityOptions& options = {},
                       const std::vector<Condenser>& condensers = {})
{
    ExecutionContext context;
    return certified_capacities(vertices, triangles, condensers, options, context);
}

/// A panel rolled up: a prism without bottom and top. Its capacity is girth over height exactly, up to rounding of the
/// vertices.
std::pair<Vertices, Triangles> prism(int sides, int rows, double height)
{
    Vertices vertices(sides * (rows + 1), 3);
    Triangles triangles(2 * sides * rows, 3);
    for (int i = 0; i <= rows; ++i)
        for (int j = 0; j < sides; ++j) {
            const double angle = 2.0 * M_PI * j / sides;
            vertices.row(i * sides + j) << std::cos(angle), std::sin(angle), height * i / rows;
        }
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < sides; ++j) {
            const int a = i * sides + j, b = i * sides + (j + 1) % sides;
            triangles.row(2 * (i * sides + j)) << a, b, b + sides;
            triangles.row(2 * (i * sides + j) + 1) << a, b + sides, a + sides;
        }
    return {vertices, triangles};
}

}  // namespace

TEST(CertifiedCapacities, a_prism_has_girth_over_height)
{
    const auto [vertices, triangles] = prism(12, 3, 2.0);
    const double girth = 24.0 * std::sin(M_PI / 12.0);
    const CapacityReport report = enclose(vertices, triangles);
    ASSERT_EQ(report.capacities.size(), 1u);
    EXPECT_LE(report.capacities[0].value.lower, girth / 2.0 + 1e-14);
    EXPECT_GE(report.capacities[0].value.upper, girth / 2.0 - 1e-14);
    EXPECT_LT(report.capacities[0].value.width(), 1e-11);
    EXPECT_TRUE(report.modulus->lower <= 2.0 / girth && 2.0 / girth <= report.modulus->upper);
    EXPECT_NEAR(report.inner_radius->lower, std::exp(-4.0 * M_PI / girth), 1e-11);
}
