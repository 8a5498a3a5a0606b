#include "core/errors.h"
#include "planar_domain/planar_map.h"
#include "shape/conformal_module.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

using namespace koebe;

namespace {

constexpr double pi = std::numbers::pi;

PlanarResult mapped(const std::vector<PlanarRim>& rims)
{
    ExecutionContext context;
    return planar_map(rims, {}, context);
}

/// A closed curve through its values at angles of equal distance.
PlanarRim smooth_rim(const std::function<Complex(double)>& at)
{
    constexpr int count = 128;
    PlanarRim rim{.lowest = -count / 2};
    for (int k = rim.lowest; k < count / 2; ++k) {
        Complex sum = 0.0;
        for (int j = 0; j < count; ++j) {
            const double t = 2.0 * pi * (j + 0.5) / count;
            sum += at(t) * std::polar(1.0 / count, -k * t);
        }
        rim.fourier.push_back(sum);
    }
    return rim;
}

/// The inverse of Joukowski's map with the focuses a and b: the outside of the chord goes to the outside of the circle.
struct Opening {
    Complex a, b;

    Complex in_units(Complex z) const { return (2.0 * z - a - b) / (b - a); }
    Complex operator()(Complex z) const
    {
        const Complex u = in_units(z);
        return u + std::sqrt(u - 1.0) * std::sqrt(u + 1.0);
    }
    /// An analytic arc from a to b, -1 <= x <= 1, becomes a closed curve: x = cos t, once along each side.
    Complex on_arc(const std::function<Complex(double)>& arc, double t) const
    {
        const double x = std::cos(t);
        const Complex u = in_units(arc(x));
        return u + Complex(0.0, std::sin(t)) * std::sqrt((u * u - 1.0) / (x * x - 1.0));
    }
};

/// The sphere without three arcs of 60 degrees of a circle, each made a closed curve. By symmetry a regular hexagon is
/// the half of it.
std::vector<PlanarRim> doubled_hexagon()
{
    const auto arc = [](int k) { return [k](double x) { return std::polar(1.0, pi * (4.0 * k + x) / 6.0); }; };
    const Opening first{arc(0)(-1.0), arc(0)(1.0)};
    const auto inside = [&](int k) { return [&, k](double x) { return 1.0 / first(arc(k)(x)); }; };
    const Opening second{inside(1)(-1.0), inside(1)(1.0)};
    const auto last = [&](double x) { return second(inside(2)(x)); };
    const Opening third{last(-1.0), last(1.0)};
    return {smooth_rim([&](double t) { return third(second(1.0 / first.on_arc(arc(0), t))); }),
            smooth_rim([&](double t) { return third(second.on_arc(inside(1), t)); }),
            smooth_rim([&](double t) { return third.on_arc(last, t); })};
}

std::vector<PlanarRim> plate()
{
    return {polygon_rim({0.0, 8.0, {8.0, 8.0}, {0.0, 8.0}}),
            polygon_rim({{1.0, 1.0}, {3.0, 1.0}, {3.0, 3.0}, {1.0, 3.0}}), ellipse_rim({5.5, 5.0}, 1.5, 0.7, 0.4)};
}

}  // namespace

TEST(PlanarMap, ellipses_with_the_same_focuses)
{
    const auto ellipse = [](double r) { return ellipse_rim(0.0, r + 1.0 / r, r - 1.0 / r, 0.0); };
    const PlanarResult ring = mapped({ellipse(1.2), ellipse(3.0)});
    EXPECT_TRUE(ring.converged);
    EXPECT_EQ(ring.order, (std::vector<int>{1, 0}));
    EXPECT_NEAR(ring.module[0], 1.2 / 3.0, ring.module_errors[0] + 1e-14);
}

TEST(PlanarMap, a_doubled_hexagon)
{
    const PlanarResult found = mapped(doubled_hexagon());
    EXPECT_TRUE(found.converged);
    const double exact[] = {0.02594142, 0.16303084, 0.02525147};
    for (int l = 0; l < 3; ++l) EXPECT_NEAR(found.module[l], exact[l], 5e-9);
}

TEST(PlanarMap, the_inverse_takes_images_back)
{
    const PlanarResult found = mapped(plate());
    VectorXcd places(3);
    places << Complex(3.0, 2.0), Complex(4.0, 1.0), Complex(7.99, 7.5);
    EXPECT_LT((found.map.inverse(found.map(places)) - places).cwiseAbs().maxCoeff(), 1e-8);
    EXPECT_NEAR(std::abs(found.map(VectorXcd::Zero(1))[0]), 1.0, 1e-9);  // a corner
    places[2] = {2.0, 2.0};
    try {
        found.map(places);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.elements(), (std::vector<Index>{2}));
    }
}

TEST(PlanarMap, more_poles_are_as_near_as_they_say)
{
    ExecutionContext context;
    const PlanarResult exact = mapped(plate()), rough = planar_map(plate(), {.tolerance = 1e-5}, context);
    EXPECT_LT(rough.levels, exact.levels);
    for (Eigen::Index l = 0; l < exact.module.size(); ++l) {
        EXPECT_GT(rough.module_errors[l], 0.0);
        EXPECT_NEAR(rough.module[l], exact.module[l], rough.module_errors[l] + exact.module_errors[l]);
    }
}

// A disk round its pole goes to the plane without a segment of four radii; a ring's circular slits are its circles.
TEST(PlanarMap, slits_of_a_disk_and_of_a_ring)
{
    ExecutionContext context;
    const PlanarOptions options{.slits = SlitKind::parallel, .slit_angle = 90.0, .pole = Complex(3.0, 1.0)};
    const PlanarResult disk = planar_map({ellipse_rim({3.0, 1.0}, 2.0, 2.0, 0.0)}, options, context);
    EXPECT_TRUE(disk.converged);
    EXPECT_LT(std::abs(disk.slits[0].begin - Complex(0.0, -1.0)), 1e-11);
    EXPECT_LT(std::abs(disk.slits[0].end - Complex(0.0, 1.0)), 1e-11);
    const PlanarResult ring = planar_map({polygon_rim({0.0, 3.0, {0.0, 3.0}}), ellipse_rim({0.8, 0.7}, 0.3, 0.2, 0.0)},
                                         {.slits = SlitKind::radial}, context);
    EXPECT_NEAR(ring.slits[1].begin.real(), ring.module[0], 1e-10);
}

// Images of each rim lie on its slit, and between its ends.
TEST(PlanarMap, rims_go_to_their_slits)
{
    for (const SlitKind kind : {SlitKind::parallel, SlitKind::circular, SlitKind::radial}) {
        PlanarOptions options{.slits = kind, .slit_angle = 30.0};
        if (kind == SlitKind::parallel) options.pole = Complex(4.0, 1.5);
        ExecutionContext context;
        std::vector<PlanarRim> rims = plate();
        rims.push_back(ellipse_rim({2.0, 6.0}, 0.5, 0.5, 0.0));
        const PlanarResult found = planar_map(rims, options, context);
        EXPECT_TRUE(found.converged);
        for (std::size_t k = 0; k < found.order.size(); ++k) {
            const RimPolygon rim = rim_polygon(rims[found.order[k]]);
            const Slit& slit = found.slits[k];
            const bool is_round = kind != SlitKind::parallel && k < 2;
            for (std::size_t i = 0; i < rim.points.size(); i += 7) {
                const Complex w = found.map.slit_images(VectorXcd::Constant(1, rim.points[i]))[0];
                const double size = std::abs(slit.end - slit.begin);
                if (is_round || kind == SlitKind::circular) {
                    EXPECT_NEAR(std::abs(w), std::abs(slit.begin), 1e-9);
                } else {
                    EXPECT_NEAR(((w - slit.begin) / (slit.end - slit.begin)).imag() * size, 0.0, 1e-9);
                }
                if (!is_round) {
                    EXPECT_LT(std::abs(w - slit.begin), size + 1e-9);
                    EXPECT_LT(std::abs(w - slit.end), size + 1e-9);
                }
            }
        }
    }
}

TEST(PlanarMap, slits_that_do_not_exist_are_refused)
{
    ExecutionContext context;
    const std::vector<PlanarRim> disk{ellipse_rim(0.0, 1.0, 1.0, 0.0)};
    EXPECT_THROW(planar_map(disk, {.slits = SlitKind::circular}, context), InputError);
    EXPECT_THROW(planar_map(disk, {.slits = SlitKind::parallel}, context), InputError);
    for (const Complex pole : {Complex(1.0), Complex(2.0), Complex(NAN)})
        EXPECT_THROW(planar_map(disk, {.slits = SlitKind::parallel, .pole = pole}, context), InputError);
    EXPECT_THROW(mapped(disk).map.slit_images(VectorXcd::Zero(1)), InputError);
}
