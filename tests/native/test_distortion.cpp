#include "circle_domain.h"
#include "planar_map.h"
#include "quality/distortion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace koebe;
using namespace koebe::test;

TEST(Distortion, of_a_similarity_is_none)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 1000);
    const Vertices surface = 37.0 * lift(domain.points, Lift::plane);
    const VectorXcd turned = std::polar(0.9, 1.2) * domain.points;
    const ComputedDistortion d = measure_distortion(surface, domain.triangles, planar(turned));
    EXPECT_LT(d.angle_error_deg.max, 1e-10);
    EXPECT_LT(d.beltrami.max, 1e-12);
    EXPECT_LT(d.area.log_sd, 1e-7);
    EXPECT_NEAR(d.conformal_energy, 0.0, 1e-13);
}

TEST(Distortion, of_a_stretch_is_known)
{
    // (x, y) -> (x, y/2): mu = (1 - 1/2) / (1 + 1/2) = 1/3; energy 1/2 (1 + 1/4) A - A/2 = A/8.
    Vertices vertices(3, 3);
    vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0;
    Triangles triangles(1, 3);
    triangles << 0, 1, 2;
    PlanarPoints uv(3, 2);
    uv << 0, 0, 1, 0, 0, 0.5;
    const ComputedDistortion d = measure_distortion(vertices, triangles, uv);
    EXPECT_NEAR(d.beltrami.mean, 1.0 / 3.0, 1e-14);
    EXPECT_NEAR(d.conformal_energy, 0.5 / 8.0, 1e-14);
    const double angle = std::atan(0.5) * 180.0 / std::numbers::pi;
    EXPECT_NEAR(d.angle_error_deg.max, 45.0 - angle, 1e-12);
    EXPECT_NEAR(d.angle_error_deg.mean, 2.0 * (45.0 - angle) / 3.0, 1e-12);
}

TEST(Distortion, counts_flips_in_32_bits)
{
    const auto [vertices, triangles] = TwoFaces({0, 0, 1, 0, 0, 1, 1, 1}, {0, 1, 2, 1, 3, 2});
    PlanarPoints uv(4, 2);
    uv << 0, 0, 0.5, 0, 0, 0.5, 0.1, 0.1;  // the second face folded over
    EXPECT_EQ(judge_disk(vertices, triangles, uv).flipped, (std::vector<Index>{1}));
    uv << 0.5, 0.5, 0.5 + 1e-9, 0.5, 0.5, 0.5 + 1e-9, 0.9, 0.9;  // the first one positive in 64 bits only
    const Verdict tiny = judge_disk(vertices, triangles, uv);
    EXPECT_EQ(tiny.flipped.front(), 0);
    EXPECT_EQ(tiny.below_resolution, (std::vector<Index>{0}));
}

TEST(Verdict, of_lost_and_turned_faces_is_known_in_any_unit)
{
    // Three right triangles of areas 1/2, 1/2 and 1: drawn true; on one point in 32 bits; true but turned over.
    Vertices vertices(9, 3);
    vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 3, 0, 0, 4, 0, 0, 3, 1, 0, 5, 0, 0, 7, 0, 0, 5, 1, 0;
    Triangles triangles(3, 3);
    triangles << 0, 1, 2, 3, 4, 5, 6, 7, 8;
    PlanarPoints uv(9, 2);
    uv << 0, 0, 0.1, 0, 0, 0.1, 0.5, 0.5, 0.5 + 1e-9, 0.5, 0.5, 0.5 + 1e-9, 0.6, 0, 0.6, 0.2, 0.7, 0;
    for (const double unit : {1.0, 1e-300, 1e300}) {
        const Verdict none_turned = judge_corners(unit * vertices, triangles, uv);
        EXPECT_EQ(none_turned.flipped, (std::vector<Index>{1, 2})) << unit;
        EXPECT_EQ(none_turned.below_resolution, (std::vector<Index>{1})) << unit;
        EXPECT_NEAR(none_turned.lost_area, 0.75, 1e-12) << unit;
        const Verdict turned = judge_corners(unit * vertices, triangles, uv, {2});
        EXPECT_EQ(turned.flipped, (std::vector<Index>{1})) << unit;
        EXPECT_NEAR(turned.lost_area, 0.25, 1e-12) << unit;
        // The face on a point has right angles: 0, 45 and 45 degrees off, of nine corners in all.
        EXPECT_NEAR(turned.angle_error_stored_deg.mean, 90.0 / 9.0, 1e-4) << unit;
        EXPECT_NEAR(turned.angle_error_stored_deg.max, 45.0, 1e-4) << unit;
        const Verdict left_out = judge_corners(unit * vertices, triangles, uv, {2}, {1});
        EXPECT_TRUE(left_out.flipped.empty()) << unit;
        EXPECT_NEAR(left_out.lost_area, 0.25, 1e-12) << unit;
        EXPECT_LT(left_out.angle_error_stored_deg.max, 1e-4) << unit;
    }
}

TEST(Distortion, leaves_out_faces_without_area_on_the_surface)
{
    const auto [vertices, triangles] = TwoFaces({0, 0, 1, 0, 0, 1, 2, 0}, {0, 1, 2, 0, 3, 1});
    PlanarPoints uv(4, 2);
    uv << 0, 0, 0.5, 0, 0, 0.5, 0.3, -0.3;
    const ComputedDistortion d = measure_distortion(vertices, triangles, uv);
    EXPECT_TRUE(std::isfinite(d.area.log_sd));
    EXPECT_LT(d.angle_error_deg.max, 1e-10);
}
