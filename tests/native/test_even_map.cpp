#include "circles/circle_fit.h"
#include "even/even_map.h"
#include "foldover/newton_system.h"
#include "foldover/turn_upright.h"
#include "grids.h"
#include "mesh/topology.h"
#include "planar/boundary_crossings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

using namespace koebe;

namespace {

using std::numbers::pi;

/// A grid of the plane, rolled up without stretching, and a conformal map of it that is anything but even.
struct Strip {
    Vertices vertices;
    PlanarPoints flat, mapped;
    Surface surface;

    /// @param place of each corner of the unit grid @param rolled into space, without stretching
    Strip(int columns, int rows, const std::function<Complex(double, double)>& place,
          const std::function<Eigen::RowVector3d(Complex)>& rolled, const std::function<Complex(Complex)>& map)
    {
        vertices.resize((columns + 1) * (rows + 1), 3);
        flat.resize(vertices.rows(), 2);
        mapped.resize(vertices.rows(), 2);
        const auto at = [&](int i, int j) { return static_cast<Index>(i * (rows + 1) + j); };
        for (int i = 0; i <= columns; ++i)
            for (int j = 0; j <= rows; ++j) {
                const Complex z = place(i / double(columns), j / double(rows)), w = map(z);
                flat.row(at(i, j)) << z.real(), z.imag();
                mapped.row(at(i, j)) << w.real(), w.imag();
                vertices.row(at(i, j)) = rolled(z);
            }
        surface = analyze_surface(test::grid(columns, rows, at), static_cast<Index>(vertices.rows()));
    }

    FlatSurface view(PlanarPoints& points, std::vector<RoundLoop>& round) const
    {
        return {vertices, surface.triangles, surface.loops, points, round};
    }
};

Eigen::RowVector3d as_it_is(Complex z) { return {z.real(), z.imag(), 0.0}; }

/// The largest relative error of an edge's length.
double worst_stretch(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& points)
{
    double worst = 0.0;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const Index a = triangles(f, k), b = triangles(f, (k + 1) % 3);
            const double length = (vertices.row(a) - vertices.row(b)).norm();
            worst = std::max(worst, std::abs((points.row(a) - points.row(b)).norm() / length - 1.0));
        }
    return worst;
}

double least_area(const Triangles& triangles, const PlanarPoints& points)
{
    double least = 1.0;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const Eigen::RowVector2d a = points.row(triangles(f, 1)) - points.row(triangles(f, 0));
        const Eigen::RowVector2d b = points.row(triangles(f, 2)) - points.row(triangles(f, 0));
        least = std::min(least, a[0] * b[1] - a[1] * b[0]);
    }
    return least;
}

/// A ring with a round hole, an eighth of an ellipse's shape outside: its exact flat shape is known.
Complex holed_place(double turn, double out)
{
    const Complex direction = std::polar(1.0, -2.0 * pi * turn);
    const Complex rim = Complex(1.4 * direction.real(), direction.imag());
    return (1.0 - out) * 0.4 * direction + out * rim;
}

}  // namespace

TEST(EvenMap, what_was_rolled_up_comes_out_flat_at_the_end_true_to_size)
{
    const Strip panel(
        12, 8, [](double u, double v) { return Complex(2.0 * u, v); },
        [](Complex z) -> Eigen::RowVector3d {
            return {std::sin(z.real()), z.imag(), std::cos(z.real())};
        },
        [](Complex z) { return std::exp(0.8 * z); });
    Strip fine =
        panel;  // chords are shorter than arcs: the flat shape of the faces is the plane's, each strip by itself
    PlanarPoints points = fine.mapped;
    std::vector<RoundLoop> round;
    ExecutionContext context;
    const EvenMap result = make_even(fine.view(points, round), 1.0, 10.0, context);
    EXPECT_TRUE(result.moved);
    EXPECT_EQ(result.rounds, 0);
    EXPECT_LT(worst_stretch(fine.vertices, fine.surface.triangles, points), 1e-7);
}

TEST(EvenMap, faces_get_the_sizes_that_are_asked_for)
{
    const auto place = [](double u, double v) { return Complex(20.0 * u, v); };
    const Strip band(80, 4, place, as_it_is, [](Complex z) { return z; });
    PlanarPoints points = band.mapped;
    std::vector<RoundLoop> round;
    ExecutionContext context;
    FlatSurface flat = band.view(points, round);
    flat.sizes = VectorXd::Ones(band.surface.triangles.rows());
    for (Eigen::Index f = 0; f < flat.sizes.size(); ++f)
        if (f / 2 % 80 < 40) flat.sizes[f] = 4.0;  // the first half of the columns
    EXPECT_TRUE(make_even(flat, 1.0, 100.0, context).moved);
    const auto stretch = [&](Index a, Index b) {
        return (points.row(a) - points.row(b)).norm() / (band.flat.row(a) - band.flat.row(b)).norm();
    };
    const auto at = [](int i, int j) { return static_cast<Index>(5 * i + j); };
    for (const auto& [from, to] : {std::pair(at(10, 0), at(11, 0)), std::pair(at(10, 2), at(10, 3))})
        EXPECT_NEAR(stretch(from, to), 2.0, 1e-3);
    for (const auto& [from, to] : {std::pair(at(70, 0), at(71, 0)), std::pair(at(70, 2), at(70, 3))})
        EXPECT_NEAR(stretch(from, to), 1.0, 1e-3);
}

TEST(EvenMap, angles_weigh_more_the_lower_the_dial)
{
    EXPECT_EQ(area_weight(0.0), 0.0);
    EXPECT_NEAR(area_weight(0.1), 0.1, 1e-12);
    EXPECT_NEAR(area_weight(1.0), 10.0, 1e-12);
}

TEST(EvenMap, a_round_hole_stays_round_and_gets_its_true_size)
{
    Triangles triangles;
    const int around = 48, out = 8;
    Vertices vertices(around * (out + 1), 3);
    PlanarPoints points(vertices.rows(), 2);
    triangles.resize(2 * around * out, 3);
    for (int i = 0; i < around; ++i)
        for (int j = 0; j <= out; ++j) {
            const Complex z = holed_place(i / double(around), j / double(out));
            const Complex w = z / (1.0 - Complex(0.3, 0.2) * z);  // a Moebius map: circles stay circles
            vertices.row(i * (out + 1) + j) << z.real(), z.imag(), 0.0;
            points.row(i * (out + 1) + j) << w.real(), w.imag();
        }
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < out; ++j) {
            const Index a = i * (out + 1) + j, b = (i + 1) % around * (out + 1) + j;
            triangles.row(2 * (i * out + j)) << a, b + 1, a + 1;
            triangles.row(2 * (i * out + j) + 1) << a, b, b + 1;
        }
    if (least_area(triangles, points) < 0.0) triangles.col(1).swap(triangles.col(2));
    const Surface surface = analyze_surface(triangles, static_cast<Index>(vertices.rows()));
    ASSERT_EQ(surface.loops.size(), 2u);
    const std::size_t hole =
        std::abs(enclosed_area(surface.loops[0], points)) < std::abs(enclosed_area(surface.loops[1], points)) ? 0 : 1;
    VectorXcd rim(around);
    for (int i = 0; i < around; ++i) rim[i] = {points(i * (out + 1), 0), points(i * (out + 1), 1)};
    std::vector<RoundLoop> round(1);
    round[0].vertices = surface.loops[hole];
    round[0].track.circle = fit_circle_least_squares(rim);
    ExecutionContext context;
    EXPECT_TRUE(make_even({vertices, surface.triangles, surface.loops, points, round}, 1.0, 10.0, context).moved);
    EXPECT_NEAR(round[0].track.circle.radius, 0.4, 1e-6);
    EXPECT_LT(worst_stretch(vertices, surface.triangles, points), 1e-5);
    for (const Index v : surface.loops[hole]) {
        const Complex arm = Complex(points(v, 0), points(v, 1)) - round[0].track.circle.center;
        EXPECT_NEAR(std::abs(arm), round[0].track.circle.radius, 1e-12);
    }
}

TEST(EvenMap, a_kept_pattern_changes_nothing)
{
    const auto place = [](double u, double v) { return Complex(2.0 * u, v); };
    const Strip strip(12, 8, place, as_it_is, [](Complex z) { return std::exp(0.5 * z); });
    NewtonPattern pattern;
    for (const Index first : {0, 9 * 12, 0}) {  // one end on a circle, then the other: as many unknowns, others
        const auto relaxed = [&](NewtonPattern* kept) {
            PlanarPoints points = strip.mapped;
            std::vector<RoundLoop> round(1);
            for (Index v = first; v < first + 9; ++v) round[0].vertices.push_back(v);
            round[0].track.circle = {0.0, points.row(first).norm()};
            ExecutionContext context;
            EXPECT_TRUE(make_even(strip.view(points, round), 0.6, 10.0, context, {2, 0, 2}, kept).moved);
            return points;
        };
        EXPECT_EQ(relaxed(&pattern), relaxed(nullptr)) << first;
        EXPECT_EQ(relaxed(&pattern), relaxed(nullptr)) << first;
    }
}

TEST(EvenMap, a_strip_that_would_lie_over_itself_does_not)
{
    // A flat ring of one and a third turns, wound up in space: its true shape covers itself.
    const double turns = 1.35;
    const Strip winding(
        60, 4, [](double u, double v) { return Complex(u, v); },
        [&](Complex z) -> Eigen::RowVector3d {
            const double angle = 2.0 * pi * turns * z.real(), radius = 1.0 + 0.5 * z.imag();
            return {radius * std::cos(angle), radius * std::sin(angle), 0.02 * z.real()};
        },
        [&](Complex z) { return Complex(2.0 * pi * turns * z.real(), -0.5 * z.imag()); });
    PlanarPoints points = winding.mapped;
    Triangles triangles = winding.surface.triangles;
    if (least_area(triangles, points) < 0.0) triangles.col(1).swap(triangles.col(2));
    const Surface surface = analyze_surface(triangles, static_cast<Index>(points.rows()));
    std::vector<RoundLoop> round;
    ExecutionContext context;
    const EvenMap result =
        make_even({winding.vertices, surface.triangles, surface.loops, points, round}, 0.9, 20.0, context);
    EXPECT_TRUE(result.moved);
    EXPECT_GT(result.rounds, 0);
    EXPECT_GT(least_area(surface.triangles, points), 0.0);
    EXPECT_TRUE(crossing_boundary_edges(surface.loops, points, 0.0).empty());
}

TEST(EvenMap, a_few_faces_turned_over_are_turned_back_first)
{
    const Strip strip(
        6, 6, [](double u, double v) { return Complex(u, v); }, as_it_is, [](Complex z) { return std::exp(z); });
    for (const Complex off : {Complex(5.0, 5.0), Complex(0.0, 0.7)}) {
        PlanarPoints points = strip.mapped;
        points.row(24) += Eigen::RowVector2d(off.real(), off.imag());
        ASSERT_LT(least_area(strip.surface.triangles, points), 0.0);
        std::vector<RoundLoop> round;
        ExecutionContext context;
        EXPECT_TRUE(make_even(strip.view(points, round), 1.0, 10.0, context).moved);
        EXPECT_LT(worst_stretch(strip.vertices, strip.surface.triangles, points), 1e-6);
    }
}

TEST(EvenMap, a_map_that_crosses_itself_stays_as_it_is)
{
    const Strip strip(
        40, 4, [](double u, double v) { return Complex(8.0 * u, v); }, as_it_is,
        [](Complex z) { return (3.0 - z.imag()) * std::polar(1.0, z.real()); });
    PlanarPoints points = strip.mapped;
    ASSERT_GT(least_area(strip.surface.triangles, points), 0.0);
    const PlanarPoints before = points;
    std::vector<RoundLoop> round;
    ExecutionContext context;
    EXPECT_FALSE(make_even(strip.view(points, round), 0.5, 10.0, context).moved);
    EXPECT_EQ(points, before);
}

TEST(TurnUpright, moves_only_what_is_near_and_not_fixed)
{
    const Strip strip(
        30, 30, [](double u, double v) { return Complex(u, v); }, as_it_is, [](Complex z) { return 2.0 * z; });
    const Index fallen = 15 * 31 + 15;
    std::vector<char> fixed(static_cast<std::size_t>(strip.mapped.rows()), 0);
    PlanarPoints points = strip.mapped;
    points.row(fallen) << 1.2, 1.0;
    const PlanarPoints before = points;
    ASSERT_LT(least_area(strip.surface.triangles, points), 0.0);
    ExecutionContext context;
    const auto turn = [&] {
        return turn_upright(strip.vertices, strip.surface.triangles, strip.surface.loops, fixed, points, context);
    };
    ASSERT_TRUE(turn());
    EXPECT_GT(least_area(strip.surface.triangles, points), 0.0);
    for (Index v = 0; v < static_cast<Index>(points.rows()); ++v)
        if (std::max(std::abs(v / 31 - 15), std::abs(v % 31 - 15)) > 18) {
            EXPECT_EQ(points.row(v), before.row(v));
        }
    fixed.assign(fixed.size(), 1);
    points = before;
    EXPECT_FALSE(turn());
    EXPECT_EQ(points, before);
}
