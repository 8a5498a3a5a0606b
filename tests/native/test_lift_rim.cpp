#include "lift/border_room.h"
#include "lift/bridges.h"
#include "lift/clipped_outlines.h"
#include "lift/even_sites.h"
#include "lift/filled_sheet.h"
#include "lift/lift.h"
#include "lift/patterns.h"
#include "mesh/topology.h"

#include "circle_domain.h"
#include "planar_map.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

using namespace koebe;

namespace {

using std::numbers::pi;

/// The plane of circles as a sheet: lengths in the UVs are lengths on the surface.
FlatSheet plane_sheet(const test::CircleDomain& domain)
{
    PlanarPoints uv(domain.triangles.size(), 2);
    for (Eigen::Index c = 0; c < uv.rows(); ++c) {
        const Complex z = domain.points[domain.triangles.data()[c]];
        uv.row(c) << z.real(), z.imag();
    }
    return flat_sheet(test::lift(domain.points, test::Lift::plane), domain.triangles, uv);
}

DrawnOutline polygon_about(const FlatSheet& sheet, Complex middle, double radius, Index group, int corners = 64)
{
    DrawnOutline outline;
    for (int k = 0; k < corners; ++k) outline.points.push_back(middle + std::polar(radius, 2.0 * pi * k / corners));
    outline.group = group;
    for (Index f = 0; f < static_cast<Index>(sheet.triangles.rows()) && outline.face < 0; ++f)
        if (sheet.twice_area(f) > 0.0 && sheet.weights_of(f, outline.points[0]).minCoeff() >= 0.0) outline.face = f;
    return outline;
}

/// The surface without the faces inside outlines.
Surface cut_out(const FlatSheet& filled, const Overlay& overlay, double& area)
{
    std::vector<Index> corners;
    area = 0.0;
    for (Index f = 0; f < static_cast<Index>(overlay.triangles.rows()); ++f) {
        if (!filled.on_surface(overlay.face[f])) continue;
        if (overlay.region[f] >= 0) {
            const Complex a = overlay.uv[3 * f], b = overlay.uv[3 * f + 1] - a, c = overlay.uv[3 * f + 2] - a;
            area += 0.5 * (b.real() * c.imag() - b.imag() * c.real());
            continue;
        }
        for (int k = 0; k < 3; ++k) corners.push_back(overlay.triangles(f, k));
    }
    const Triangles rest =
        Eigen::Map<const Triangles>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3), 3);
    return analyze_surface(rest, static_cast<Index>(overlay.vertices.rows()));
}

/// Area of the common part of two circles with this distance.
double lens_area(double r, double s, double distance)
{
    const double x = (distance * distance + r * r - s * s) / (2.0 * distance), y = distance - x;
    return r * r * std::acos(x / r) - x * std::sqrt(r * r - x * x) + s * s * std::acos(y / s) -
           y * std::sqrt(s * s - y * y);
}

LiftResult lifted_tube(LiftOptions options, const std::string& pattern)
{
    constexpr int around = 60, rows = 20;
    Vertices vertices(around * (rows + 1), 3);
    Triangles triangles(2 * around * rows, 3);
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i < around; ++i)
            vertices.row(j * around + i) << std::cos(2 * pi * i / around), std::sin(2 * pi * i / around), 0.1 * j;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < around; ++i) {
            const int a = j * around + i, b = j * around + (i + 1) % around;
            triangles.row(2 * a) << a, b, b + around;
            triangles.row(2 * a + 1) << a, b + around, a + around;
        }
    options.shape = LiftShape::ring;
    ExecutionContext context;
    return lift(vertices, triangles, pattern, options, context);
}

bool is_closed(const LiftResult& result)
{
    const Surface surface = analyze_surface(result.triangles, static_cast<Index>(result.vertices.rows()));
    return surface.loops.empty() && surface.reoriented.empty();
}

}  // namespace

TEST(FilledSheet, CoversTheBoxOnce)
{
    const FlatSheet sheet = plane_sheet(test::make_circle_domain(test::five_circles(), 3000));
    const FlatSheet filled = filled_sheet(sheet);
    double area = 0.0;
    for (Index f = 0; f < static_cast<Index>(filled.triangles.rows()); ++f) {
        EXPECT_GT(filled.twice_area(f), 0.0);
        area += 0.5 * filled.twice_area(f);
    }
    const Eigen::RowVector3d size = sheet.vertices.colwise().maxCoeff() - sheet.vertices.colwise().minCoeff();
    const double beyond = 2.0 * size.maxCoeff();  // on both sides together
    EXPECT_NEAR(area, (size[0] + beyond) * (size[1] + beyond), 1e-10);
    EXPECT_EQ(std::ranges::max(filled.gap), 4) << "four holes and the void around";
    EXPECT_EQ(std::ranges::count(filled.border, 1), 6) << "sides of the box, two of them in two";
    EXPECT_EQ(filled.area, sheet.area);
}

TEST(Clip, TakesThePartOnTheSurface)
{
    const test::CircleDomain domain = test::make_circle_domain(test::five_circles(), 20000);
    const FlatSheet filled = filled_sheet(plane_sheet(domain));
    const Circle hole = domain.circles[1];
    const double radius = 0.5 * hole.radius;
    double area = 0.0;
    const ClippedOverlay bay =
        draw_clipped_outlines(filled, {polygon_about(filled, hole.center + hole.radius, radius, 0)}, {}, true);
    EXPECT_EQ(bay.outlines, 1);
    EXPECT_EQ(bay.holes, 0) << "a bay of a hole is no hole";
    const Surface surface = cut_out(filled, bay.overlay, area);
    EXPECT_EQ(surface.loops.size(), 5U);
    EXPECT_NEAR(area / (pi * radius * radius - lens_area(hole.radius, radius, hole.radius)), 1.0, 0.02);
    const ClippedOverlay whole =
        draw_clipped_outlines(filled, {polygon_about(filled, hole.center, 1.1 * hole.radius, 0)}, {}, true);
    EXPECT_EQ(whole.outlines, 1);
    EXPECT_EQ(whole.holes, 0) << "the hole became larger";
    EXPECT_EQ(cut_out(filled, whole.overlay, area).loops.size(), 5U);
    EXPECT_NEAR(area / (0.21 * pi * hole.radius * hole.radius), 1.0, 0.05);
    const ClippedOverlay beyond = draw_clipped_outlines(filled, {polygon_about(filled, {1.5, 1.5}, 0.2, 0)}, {}, true);
    EXPECT_EQ(beyond.outlines, 0) << "it is in the void";
}

TEST(Clip, JoinsHolesAndLeavesOutWhatWouldDivide)
{
    const test::CircleDomain domain = test::make_circle_domain(test::five_circles(), 20000);
    const FlatSheet filled = filled_sheet(plane_sheet(domain));
    const auto slot = [&](Complex from, Complex to, double half, Index group) {
        DrawnOutline outline;
        const Complex along = (to - from) / std::abs(to - from), across = along * Complex(0.0, half);
        for (int side = 0; side < 2; ++side)
            for (int k = 0; k < 32; ++k) {
                const double share = (k + (side == 0 ? 0.0 : 1e-9)) / 32.0;
                outline.points.push_back(side == 0 ? from - across + share * (to - from)
                                                   : to + across - share * (to - from));
            }
        outline.group = group;
        outline.face = polygon_about(filled, outline.points[0], 0.0, 0, 1).face;
        return outline;
    };
    const Circle a = domain.circles[1], b = domain.circles[2];
    double area = 0.0;
    const ClippedOverlay joined = draw_clipped_outlines(filled, {slot(a.center, b.center, 0.02, 0)}, {}, true);
    EXPECT_EQ(joined.holes, -1) << "two holes became one";
    EXPECT_EQ(cut_out(filled, joined.overlay, area).loops.size(), 4U);
    const ClippedOverlay two =
        draw_clipped_outlines(filled,
                              {slot(a.center, b.center, 0.02, 0),
                               slot(a.center + Complex(0.0, 0.06), b.center + Complex(0.0, 0.06), 0.02, 1)},
                              {}, true);
    EXPECT_EQ(two.overlay.left_out.at_border, 1) << "between the two a piece would fall out";
    EXPECT_EQ(cut_out(filled, two.overlay, area).loops.size(), 4U);
    const ClippedOverlay across = draw_clipped_outlines(filled, {slot({-1.3, -0.93}, {1.3, -0.93}, 0.02, 0)}, {}, true);
    EXPECT_EQ(across.overlay.left_out.at_border, 1) << "it would cut the disk in two";
    EXPECT_EQ(draw_clipped_outlines(filled, {slot({-1.3, -0.93}, {1.3, -0.93}, 0.02, 0)}, {}, false).outlines, 1)
        << "nothing falls out where it is raised";
}

TEST(Clip, ARingHasItsPatternUpToTheRims)
{
    for (const std::string pattern : {"hexagons", "circles", "voronoi", "stripes"}) {
        const LiftResult left = lifted_tube({.size = 0.3, .perforate = true}, pattern);
        const LiftResult clipped = lifted_tube({.size = 0.3, .rim = LiftRim::clip, .perforate = true}, pattern);
        EXPECT_GE(clipped.outlines, left.outlines) << pattern;
        if (pattern != "circles") {  // they have room beside the rims
            EXPECT_LT(clipped.loops_after - 2, clipped.outlines) << pattern << ": bays are no holes";
        }
        EXPECT_EQ(clipped.euler_after, 2 - clipped.loops_after) << pattern;
    }
}

TEST(Clip, ReliefsAndSolidsAreClosedAtTheRims)
{
    for (const std::string pattern : {"hexagons", "circles", "stripes"})
        for (const double height : {0.05, -0.03}) {
            const LiftResult sheet = lifted_tube({.size = 0.5, .rim = LiftRim::clip, .height = height}, pattern);
            const Surface surface = analyze_surface(sheet.triangles, static_cast<Index>(sheet.vertices.rows()));
            EXPECT_EQ(surface.loops.size(), 2U) << pattern;
            EXPECT_EQ(surface.euler_characteristic, 0) << pattern;
            EXPECT_TRUE(is_closed(
                lifted_tube({.size = 0.5, .rim = LiftRim::clip, .height = height, .thickness = 0.1}, pattern)))
                << pattern;
            EXPECT_TRUE(is_closed(
                lifted_tube({.size = 0.5, .rim = LiftRim::clip, .perforate = true, .thickness = 0.1}, pattern)))
                << pattern;
        }
}

TEST(BorderRoom, MakesAPolygonFit)
{
    const auto [square, faces] = test::TwoFaces({0, 0, 1, 0, 1, 1, 0, 1}, {0, 1, 2, 0, 2, 3});
    PlanarPoints uv(6, 2);
    for (int c = 0; c < 6; ++c) uv.row(c) = square.row(faces.data()[c]).leftCols<2>();
    const BorderRoom room(flat_sheet(square, faces, uv), 0.2);
    const auto box = [](Complex middle, double half) {
        return std::vector<Complex>{middle + Complex(-half, -half), middle + Complex(half, -half),
                                    middle + Complex(half, half), middle + Complex(-half, half)};
    };
    EXPECT_TRUE(room.fits(box({0.5, 0.5}, 0.399), 0.1));
    EXPECT_FALSE(room.fits(box({0.5, 0.5}, 0.401), 0.1));
    EXPECT_FALSE(room.fits(box({0.5, 0.5}, 0.7), 0.1)) << "all around";
    const auto at_side = [&](double scale) { return box({0.5, 0.2}, 0.2 * scale); };
    EXPECT_NEAR(room.largest_scale(at_side, 0.039), 0.8, 1e-12);
    EXPECT_NEAR(room.largest_scale(at_side, 0.19), 1.0, 1e-12) << "none fits: it stays as it is, and is left out";
}

TEST(Bridges, HaveTheDistanceOfOutlinesInAPlane)
{
    const test::CircleDomain domain = test::make_circle_domain(test::five_circles(), 20000);
    const FlatSheet sheet = plane_sheet(domain);
    const Overlay overlay = draw_outlines(
        sheet, {polygon_about(sheet, {-0.07, -0.8}, 0.05, 0), polygon_about(sheet, {0.07, -0.8}, 0.05, 1)});
    ASSERT_EQ(overlay.outlines.size(), 2U);
    double distance = std::numeric_limits<double>::infinity();
    for (const Index v : overlay.loops[0])
        for (std::size_t i = 0; i < overlay.loops[1].size(); ++i) {
            const Eigen::RowVector3d a = overlay.vertices.row(overlay.loops[1][i]);
            const Eigen::RowVector3d way =
                overlay.vertices.row(overlay.loops[1][(i + 1) % overlay.loops[1].size()]) - a;
            const Eigen::RowVector3d to = overlay.vertices.row(v) - a;
            const double share = std::clamp(to.dot(way) / way.squaredNorm(), 0.0, 1.0);
            distance = std::min(distance, (to - share * way).norm());
        }
    std::vector<char> keep;
    for (const Index region : overlay.region) keep.push_back(region < 0);
    const ExecutionContext context;
    const ThinBridges thin = thin_bridges(sheet, overlay, keep, 0.05, context);
    EXPECT_EQ(thin.count, 1);
    ASSERT_TRUE(thin.thinnest.has_value());
    EXPECT_LE(*thin.thinnest, distance + 1e-15);
    EXPECT_NEAR(*thin.thinnest, distance, 1e-4) << "an edge of the one may be nearer to a vertex of the other";
    EXPECT_NEAR(*thin.thinnest, 0.04, 1e-3);
    for (const Index f : thin.faces) EXPECT_LT(std::abs(sheet.corner(f, 0) - Complex(0.0, -0.8)), 0.1);
    EXPECT_EQ(thin_bridges(sheet, overlay, keep, 0.039, context).count, 0);
    EXPECT_GT(thin_bridges(sheet, overlay, keep, 0.4, context).count, 1) << "to the rim and holes";
}

TEST(Bridges, ToTheRimsAreKeptByWholeOutlines)
{
    const LiftOptions options{.size = 0.45, .bridge = 0.1, .perforate = true};  // 14 hexagons go round
    const LiftResult left = lifted_tube(options, "hexagons");
    EXPECT_EQ(left.thin_bridges, 28) << "the first and the last row are near the rims";
    ASSERT_TRUE(left.thinnest_bridge.has_value());
    EXPECT_LT(*left.thinnest_bridge, 0.095);
    LiftOptions fitting = options;
    fitting.rim = LiftRim::whole;
    const LiftResult whole = lifted_tube(fitting, "hexagons");
    EXPECT_EQ(whole.thin_bridges, 0);
    EXPECT_EQ(whole.outlines, left.outlines);
    EXPECT_EQ(whole.loops_after, 2 + whole.outlines);
}

TEST(EvenSites, AreAsDenseAsTheGradeAsks)
{
    FlatSheet sheet = plane_sheet(test::make_circle_domain({{{0.0, 0.0}, 1.0}}, 4000));
    sheet.grade.resize(sheet.vertices.rows());
    for (Eigen::Index v = 0; v < sheet.vertices.rows(); ++v) sheet.grade[v] = sheet.vertices(v, 0) < 0.0 ? 1.0 : 0.5;
    const std::vector<SurfacePoint> sites = even_sites(sheet, 0.1, 1);
    const auto left = std::ranges::count_if(
        sites, [&](const SurfacePoint& p) { return sheet.position_at(p.face, p.weights)[0] < 0.0; });
    const double ratio =
        static_cast<double>(static_cast<std::ptrdiff_t>(sites.size()) - left) / static_cast<double>(left);
    EXPECT_NEAR(ratio, 4.0, 0.5) << "half the size, four times as many";
    std::ranges::fill(sheet.grade, 0.05);
    EXPECT_THROW(even_sites(sheet, 0.1, 1), InputError);
}
