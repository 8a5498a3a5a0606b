#include "circle_domain.h"
#include "foldover/angle_polish.h"
#include "pipeline/uniformize.h"
#include "quality/distortion.h"

#include <gtest/gtest.h>

#include <random>

using namespace koebe;
using namespace koebe::test;

namespace {

/// A planar circle domain as the surface, mapped to itself with every vertex out of its place: those inside by up to a
/// share of their shortest edge, those of the loops along their circles.
struct Jittered {
    explicit Jittered(CircleDomain d)
        : domain(std::move(d)),
          vertices(lift(domain.points, Lift::plane)),
          surface(require_bordered_genus_zero(domain.triangles, static_cast<Index>(domain.points.size()))),
          uv(vertices.leftCols<2>())
    {
        constexpr double share = 0.15;
        VectorXd shortest = VectorXd::Constant(uv.rows(), 1.0);
        for (const auto face : domain.triangles.rowwise())
            for (int k = 0; k < 3; ++k)
                for (const Index v : {face[k], face[(k + 1) % 3]})
                    shortest[v] =
                        std::min(shortest[v], std::abs(domain.points[face[k]] - domain.points[face[(k + 1) % 3]]));
        std::vector<int> loop_of(uv.rows(), -1);
        for (std::size_t k = 0; k < domain.loops.size(); ++k)
            for (const Index v : domain.loops[k]) loop_of[v] = static_cast<int>(k);
        std::mt19937 random(7);
        std::uniform_real_distribution<double> number(-share, share);
        for (Eigen::Index v = 0; v < uv.rows(); ++v) {
            const Complex offset(number(random), number(random));
            Complex z = domain.points[v];
            if (loop_of[v] < 0) {
                z += shortest[v] * offset;
            } else {
                const Circle& circle = domain.circles[loop_of[v]];
                z = circle.center + std::polar(circle.radius, std::arg(z - circle.center) +
                                                                  offset.real() * shortest[v] / circle.radius);
            }
            uv.row(v) << z.real(), z.imag();
        }
    }

    double angle_error() const { return measure_distortion(vertices, domain.triangles, uv).angle_error_deg.mean; }
    bool polish(const std::vector<Index>& off_circle = {})
    {
        ExecutionContext context;
        return polish_angles(vertices, surface, domain.loops, domain.circles, off_circle, uv, context);
    }

    CircleDomain domain;
    Vertices vertices;
    Surface surface;
    PlanarPoints uv;
};

}  // namespace

TEST(AnglePolish, finds_the_conformal_map_of_a_circle_domain_to_itself)
{
    Jittered map(make_circle_domain(five_circles(), 3000));
    const double before = map.angle_error();
    ASSERT_GT(before, 3.0);
    EXPECT_TRUE(map.polish());
    EXPECT_LT(map.angle_error(), 1e-3 * before);
    for (std::size_t k = 0; k < map.domain.loops.size(); ++k)
        for (const Index v : map.domain.loops[k]) {
            const Circle& circle = map.domain.circles[k];
            EXPECT_NEAR(std::abs(Complex(map.uv(v, 0), map.uv(v, 1)) - circle.center), circle.radius, 1e-14);
        }
}

TEST(AnglePolish, on_a_disk_three_vertices_stay)
{
    Jittered map(make_circle_domain({Circle{}}, 1000));
    const VertexLoop& rim = map.domain.loops[0];
    const PlanarPoints before = map.uv;
    EXPECT_TRUE(map.polish());
    for (std::size_t i = 0; i < 3; ++i) {
        const Index v = rim[i * rim.size() / 3];
        EXPECT_EQ(map.uv.row(v), before.row(v));
    }
}

TEST(AnglePolish, vertices_off_their_circles_stay)
{
    Jittered map(make_circle_domain(five_circles(), 1000));
    const Index off = map.domain.loops[2][0];
    map.uv.row(off) +=
        0.01 * (Eigen::RowVector2d(map.domain.circles[2].center.real(), map.domain.circles[2].center.imag()) -
                map.uv.row(off));
    const Eigen::RowVector2d place = map.uv.row(off);
    EXPECT_TRUE(map.polish({off}));
    EXPECT_EQ(map.uv.row(off), place);
}

TEST(AnglePolish, a_map_that_cannot_be_bettered_is_left_alone)
{
    Jittered map(make_circle_domain(five_circles(), 1000));
    map.uv = map.vertices.leftCols<2>();
    const PlanarPoints before = map.uv;
    map.polish();
    EXPECT_LT((map.uv - before).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(AnglePolish, lowers_the_error_of_a_uniformization_and_leaves_its_circles)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 2000);
    const Vertices vertices = lift(domain.points, Lift::enneper);
    ExecutionContext context;
    UniformizeOptions options;
    const UniformizeResult plain = uniformize(vertices, domain.triangles, options, context);
    options.polish = true;
    const UniformizeResult polished = uniformize(vertices, domain.triangles, options, context);
    ASSERT_TRUE(polished.unpolished_angle_error_deg);
    EXPECT_EQ(polished.unpolished_angle_error_deg->mean, plain.distortion.angle_error_deg.mean);
    EXPECT_LT(polished.distortion.angle_error_deg.mean, plain.distortion.angle_error_deg.mean);
    EXPECT_TRUE(polished.distortion.flipped.empty());
    for (std::size_t k = 0; k < plain.loops.size(); ++k) {
        EXPECT_EQ(polished.loops[k].circle.center, plain.loops[k].circle.center);
        EXPECT_EQ(polished.loops[k].circle.radius, plain.loops[k].circle.radius);
        EXPECT_LT(polished.loops[k].roundness_projected, 1e-12);
    }
    EXPECT_FALSE(plain.unpolished_angle_error_deg);
}
