#include "foldover/angle_map.h"
#include "foldover/angle_newton.h"
#include "foldover/angle_polish.h"
#include "foldover/angle_relaxation.h"
#include "pipeline/uniformize.h"
#include "planar_map.h"
#include "quality/distortion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

using namespace koebe;
using namespace koebe::test;

namespace {

/// A planar circle domain as the surface, mapped to itself with every vertex out of its place: those inside by up to a
/// share of their shortest edge, those of the loops along their circles.
struct Jittered : PlanarMap {
    explicit Jittered(CircleDomain d) : PlanarMap(std::move(d))
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

namespace {

/// The polish's own view of a map, with its loops held.
AngleMap angles_of(const Jittered& map)
{
    AngleMap angles(map.vertices, map.domain.triangles, map.uv);
    for (const VertexLoop& loop : map.domain.loops)
        for (const Index v : loop) angles.mobility[v] = AngleMap::Mobility::held;
    return angles;
}

/// Of the errors of all corners.
double weighted_squares(AngleMap& angles, const std::vector<double>& weights)
{
    angles.measure();
    double sum = 0.0;
    for (std::size_t k = 0; k < weights.size(); ++k) sum += weights[k] * angles.error[k] * angles.error[k];
    return sum;
}

}  // namespace

TEST(AngleMap, counts_what_the_report_counts)
{
    const Jittered map(make_circle_domain(five_circles(), 1000));
    AngleMap angles = angles_of(map);
    const double degrees = angles.measure() / angles.corner_count() * 180.0 / std::numbers::pi;
    EXPECT_NEAR(degrees, map.angle_error(), 1e-7 * degrees);
}

TEST(AngleMap, the_series_of_the_arctangent_meets_the_library)
{
    for (const double angle : {-3.1, -0.25, -0.24, -1e-3, 0.0, 1e-9, 0.2, 0.2449, 0.245, 1.0, 2.0})
        EXPECT_NEAR(angle_of(std::polar(3.0, angle)), angle, 1e-8 * std::abs(angle)) << angle;
}

TEST(AngleNewton, its_places_are_least_to_first_order)
{
    // Very near to the conformal map, where first order is all there is, it is found in one step.
    const CircleDomain domain = make_circle_domain(five_circles(), 1000);
    Jittered map(domain);
    map.uv = map.vertices.leftCols<2>() + 1e-5 * (map.uv - map.vertices.leftCols<2>());
    for (const VertexLoop& loop : domain.loops)
        for (const Index v : loop) map.uv.row(v) = map.vertices.row(v).head<2>();
    AngleMap angles = angles_of(map);
    const double least = 0.3 * angles.measure() / angles.corner_count();
    std::vector<double> weights;
    for (const double e : angles.error) weights.push_back(1.0 / std::hypot(e, least));
    const double before = weighted_squares(angles, weights);
    AngleNewton newton(angles);
    ASSERT_TRUE(newton.solve(least));
    angles.points = newton.places(1.0);
    const double after = weighted_squares(angles, weights);
    EXPECT_LT(after, 1e-6 * before);
}

TEST(AngleRelaxation, each_sweep_lowers_the_error_by_what_it_says_and_flips_no_face)
{
    const Jittered map(make_circle_domain(five_circles(), 2000));
    AngleMap angles = angles_of(map);
    double error = angles.measure();
    for (int sweep = 0; sweep < 4; ++sweep) {
        const double fall = relax_angles(angles, 0.3 * error / angles.corner_count(), sweep % 2 == 0);
        EXPECT_GT(fall, 0.0);
        EXPECT_NEAR(angles.measure(), error - fall, 1e-9 * error);
        error -= fall;
        for (Index v = 0; v < angles.vertex_count(); ++v)
            for (const AngleMap::Corner& corner : angles.star(v))
                EXPECT_GT(cross(angles.points[corner.next] - angles.points[v],
                                angles.points[corner.previous] - angles.points[v]),
                          0.0);
    }
}

TEST(AngleRelaxation, no_face_is_flipped_though_that_would_lower_the_error)
{
    // A vertex between four others that the map has moved about: often its angles are best outside of them.
    std::mt19937 random(3);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    const Triangles triangles = (Triangles(4, 3) << 0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1).finished();
    for (int round = 0; round < 300; ++round) {
        Vertices vertices = Vertices::Zero(5, 3);
        PlanarPoints uv = PlanarPoints::Zero(5, 2);
        vertices.row(0) << 0.6 * number(random), 0.6 * number(random), 0.0;
        for (int k = 0; k < 4; ++k) {
            const Complex corner = std::polar(1.0, 0.5 * std::numbers::pi * k);
            vertices.row(k + 1) << corner.real(), corner.imag(), 0.0;
            uv.row(k + 1) << (0.55 + 0.45 * number(random)) * vertices.row(k + 1).head<2>();
        }
        AngleMap angles(vertices, triangles, uv);
        for (Index v = 1; v < 5; ++v) angles.mobility[v] = AngleMap::Mobility::held;
        const double least = 0.3 * angles.measure() / angles.corner_count();
        for (int sweep = 0; sweep < 10; ++sweep) relax_angles(angles, least, true);
        for (const AngleMap::Corner& corner : angles.star(0))
            EXPECT_GT(
                cross(angles.points[corner.next] - angles.points[0], angles.points[corner.previous] - angles.points[0]),
                0.0);
    }
}

TEST(AngleRelaxation, a_sliding_vertex_does_not_jump_over_the_next)
{
    // One face with two vertices on a circle, the next one ahead, and its angles those beyond the other crossing of the
    // circle with its third edge: upright too, but past the next.
    std::mt19937 random(5);
    std::uniform_real_distribution<double> number(0.0, 1.0);
    const Triangles triangles = (Triangles(1, 3) << 0, 1, 2).finished();
    const auto set = [](auto row, Complex z) { row[0] = z.real(), row[1] = z.imag(); };
    int tried = 0;
    for (int round = 0; round < 3000; ++round) {
        const double gap = 0.1 + number(random);
        const Complex first(1.0, 0.0), next = std::polar(1.0, gap),
                                       third(4.0 * number(random) - 2.0, 4.0 * number(random) - 2.0);
        const Complex beyond = std::polar(1.0, gap + 2.0 * number(random));
        if (!(cross(next - first, third - first) > 0.01) || !(cross(next - beyond, third - beyond) > 0.01)) continue;
        ++tried;
        Vertices vertices = Vertices::Zero(3, 3);
        PlanarPoints uv(3, 2);
        const Complex places[] = {first, next, third}, shapes[] = {beyond, next, third};
        for (Index v = 0; v < 3; ++v) {
            set(uv.row(v), places[v]);
            set(vertices.row(v), shapes[v]);
        }
        AngleMap angles(vertices, triangles, uv);
        for (Index v = 1; v < 3; ++v) angles.mobility[v] = AngleMap::Mobility::held;
        angles.let_slide(0, {Circle{}, 1, 1, 1.0});
        angles.measure();
        for (int sweep = 0; sweep < 5; ++sweep) relax_angles(angles, 0.01, true);
        EXPECT_GT(std::arg(next / angles.points[0]), 0.0);
        EXPECT_NEAR(std::abs(angles.points[0]), 1.0, 1e-14);
    }
    EXPECT_GT(tried, 100);
}
