#include "lift/lattice.h"
#include "lift/lift.h"
#include "lift/meeting_faces.h"
#include "lift/overlay.h"
#include "lift/patterns.h"
#include "lift/site_outlines.h"
#include "lift/solid.h"
#include "mesh/topology.h"
#include "planar/divided_polygon.h"

#include "circle_domain.h"
#include "grids.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace koebe;

namespace {

using std::numbers::pi;

/// A conformal surface with its exact map, as a sheet.
FlatSheet exact_sheet(const test::CircleDomain& domain, test::Lift kind)
{
    PlanarPoints uv(domain.triangles.size(), 2);
    for (Eigen::Index c = 0; c < uv.rows(); ++c) {
        const Complex z = domain.points[domain.triangles.data()[c]];
        uv.row(c) << z.real(), z.imag();
    }
    return flat_sheet(test::lift(domain.points, kind), domain.triangles, uv);
}

DrawnOutline circle(Complex middle, double radius, Index face, int corners = 64)
{
    DrawnOutline outline;
    for (int k = 0; k < corners; ++k) outline.points.push_back(middle + std::polar(radius, 2.0 * pi * k / corners));
    outline.face = face;
    return outline;
}

Index face_at(const FlatSheet& sheet, Complex place)
{
    for (Index f = 0; f < static_cast<Index>(sheet.triangles.rows()); ++f)
        if (sheet.weights_of(f, place).minCoeff() >= 0.0) return f;
    return -1;
}

/// Longest over shortest axis of a closed curve in space, by the moments of its points by length.
double axis_ratio(const Vertices& vertices, const std::vector<Index>& loop)
{
    Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
    double length = 0.0;
    std::vector<std::pair<Eigen::RowVector3d, double>> parts;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Eigen::RowVector3d a = vertices.row(loop[i]), b = vertices.row(loop[(i + 1) % loop.size()]);
        parts.emplace_back(0.5 * (a + b), (b - a).norm());
        middle += parts.back().second * parts.back().first;
        length += parts.back().second;
    }
    middle /= length;
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    for (const auto& [place, weight] : parts) moments += weight * (place - middle).transpose() * (place - middle);
    const Eigen::Vector3d values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments).eigenvalues();
    return std::sqrt(values[2] / values[1]);
}

/// Vertices of a cylinder of radius 1, and its faces.
std::pair<Vertices, Triangles> cylinder(int around, int rows, double height)
{
    Vertices vertices(around * (rows + 1), 3);
    const auto at = [&](int i, int j) { return static_cast<Index>(j * around + i % around); };
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i < around; ++i)
            vertices.row(at(i, j)) << std::cos(2 * pi * i / around), std::sin(2 * pi * i / around), height * j / rows;
    return {vertices, test::grid(around, rows, at)};
}

LiftResult lifted(const std::pair<Vertices, Triangles>& mesh, const std::string& pattern, const LiftOptions& options)
{
    ExecutionContext context;
    return lift(mesh.first, mesh.second, pattern, options, context);
}

double volume_of(const Vertices& vertices, const Triangles& triangles)
{
    double volume = 0.0;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        Eigen::Matrix3d corners;
        for (int k = 0; k < 3; ++k) corners.row(k) = vertices.row(triangles(f, k));
        volume += corners.determinant() / 6.0;
    }
    return volume;
}

}  // namespace

TEST(DividedPolygon, HasTheSegmentsAndOnlyTheInside)
{
    const std::vector<Complex> polygon{0.0, 1.0, 2.0, {2.0, 2.0}, {1.0, 0.5}, {0.0, 2.0}};
    const Triangles pieces = divided_polygon(polygon, {{0.5, 0.4}}, {{1, 6}, {0, 1}});
    double area = 0.0;
    std::vector<Complex> all = polygon;
    all.emplace_back(0.5, 0.4);
    bool found = false;
    for (Eigen::Index t = 0; t < pieces.rows(); ++t) {
        const Complex a = all[pieces(t, 0)], b = all[pieces(t, 1)] - a, c = all[pieces(t, 2)] - a;
        area += 0.5 * (b.real() * c.imag() - b.imag() * c.real());
        found |= (pieces.row(t).array() == 1).any() && (pieces.row(t).array() == 6).any();
    }
    EXPECT_NEAR(area, 2.5, 1e-12);
    EXPECT_TRUE(found);
    EXPECT_EQ(divided_polygon(polygon, {{0.5, 0.4}, {1.5, 0.4}}, {{6, 7}, {1, 4}}).rows(), 0) << "segments that cross";
    EXPECT_EQ(divided_polygon(polygon, {1.0}, {}).rows(), 0) << "two points at one place";
}

TEST(Lattice, StaggeredRowsNeedAnEvenNumber)
{
    const Lattice slots = lattice_of("stripes", 0.2);
    EXPECT_EQ(lay_lattice(slots, {1.0}, 0.1, 8, 0.0, {1.0, 0.1}).places.size() % 4, 0U);
    try {
        lay_lattice(slots, {1.0}, 0.1, 7, 0.0, {1.0, 0.1});
        FAIL() << "seven columns meet themselves shifted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("6 or 8"), std::string::npos) << error.what();
    }
}

TEST(Lattice, StripesAlongAreStripesAcrossTurned)
{
    const Lattice across = lattice_of("stripes", 0.2), along = lattice_of("stripes", 0.2, true);
    EXPECT_DOUBLE_EQ((std::conj(across.a) * across.b).imag(), (std::conj(along.a) * along.b).imag());
    for (std::size_t i = 0; i < along.shapes[0].size(); ++i)
        EXPECT_EQ(along.shapes[0][i], across.shapes[0][i] * Complex(0.0, 1.0));
    EXPECT_EQ(lay_lattice(along, {1.0}, 0.1, 7, 0.0, {1.0, 0.01}).places.size() % 7, 0U) << "any number fits";
}

TEST(Lattice, CoversATorusOnce)
{
    const std::vector<Complex> periods{0.9, {0.2, 0.7}};
    for (const std::string name : {"hexagons", "triangles", "diamonds", "stripes"}) {
        const LaidLattice laid = lay_lattice(lattice_of(name, 0.2), periods, 0.05, 0, 0.0, {1.0, 1.0});
        const double area = periods[0].real() * periods[1].imag() / static_cast<double>(laid.places.size());
        const Lattice one = lattice_of(name, 0.2);
        EXPECT_NEAR(area / (0.0025 * (std::conj(one.a) * one.b).imag()), 1.0, 0.2) << name;
        EXPECT_LT(laid.bend, 1.1) << name;
        for (const Complex z : laid.places)  // no two places differ by a sum of periods
            EXPECT_EQ(std::ranges::count_if(laid.places,
                                            [&](Complex w) {
                                                const double v = (w - z).imag() / 0.7,
                                                             u = ((w - z).real() - 0.2 * v) / 0.9;
                                                return std::abs(u - std::round(u)) < 1e-9 &&
                                                       std::abs(v - std::round(v)) < 1e-9;
                                            }),
                      1)
                << name;
    }
}

TEST(Overlay, LiftedCirclesAreRound)
{
    for (const test::Lift kind : test::curved_lifts) {
        double before = 0.0;
        for (const Index faces : {3000, 12000}) {
            const FlatSheet sheet = exact_sheet(test::make_circle_domain(test::five_circles(), faces), kind);
            double worst = 0.0, size = 0.04 * sheet.mean_scale;
            const std::vector<DrawnOutline> outlines =
                site_outlines(sheet, std::vector<SurfacePoint>{{face_at(sheet, {0.05, -0.75}), {0.3, 0.3, 0.4}}},
                              SiteShape::circles, size, 0.1 * size);
            const Overlay overlay = draw_outlines(sheet, outlines);
            ASSERT_EQ(overlay.loops.size(), 1U) << test::to_string(kind);
            for (const auto& loop : overlay.loops) worst = std::max(worst, axis_ratio(overlay.vertices, loop) - 1.0);
            EXPECT_LT(worst, 3.0 / std::sqrt(static_cast<double>(faces))) << test::to_string(kind);  // O(h)
            before = worst;
        }
        EXPECT_LT(before, 0.03);
    }
}

TEST(Overlay, KeepsTheSurfaceAndCountsHoles)
{
    const FlatSheet sheet = exact_sheet(test::make_circle_domain(test::five_circles(), 4000), test::Lift::enneper);
    const DrawnPattern pattern = built_in_pattern(
        sheet, "voronoi", {.size = 0.15 * std::sqrt(sheet.area), .bridge = 0.03 * std::sqrt(sheet.area)});
    const Overlay overlay = draw_outlines(sheet, pattern.outlines);
    ASSERT_GT(overlay.outlines.size(), 10U);
    EXPECT_TRUE((overlay.vertices.topRows(sheet.vertices.rows()).array() == sheet.vertices.array()).all());
    const Surface all = analyze_surface(overlay.triangles, static_cast<Index>(overlay.vertices.rows()));
    EXPECT_EQ(all.euler_characteristic, -3);
    EXPECT_EQ(all.loops.size(), 5U);
    std::vector<Index> corners;
    for (Eigen::Index f = 0; f < overlay.triangles.rows(); ++f)
        if (overlay.region[f] < 0)
            for (int k = 0; k < 3; ++k) corners.push_back(overlay.triangles(f, k));
    const Triangles rest =
        Eigen::Map<const Triangles>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3), 3);
    const Surface pierced = analyze_surface(rest, static_cast<Index>(overlay.vertices.rows()));
    EXPECT_EQ(pierced.loops.size(), 5U + overlay.outlines.size());
    EXPECT_EQ(pierced.euler_characteristic, -3 - static_cast<int>(overlay.outlines.size()));
}

TEST(Overlay, LeavesOutWhatMeetsAHoleOrAnotherOutline)
{
    const test::CircleDomain domain = test::make_circle_domain(test::five_circles(), 4000);
    const FlatSheet sheet = exact_sheet(domain, test::Lift::plane);
    const auto at = [&](Complex middle, double radius, Index group) {
        DrawnOutline outline = circle(middle, radius, face_at(sheet, middle + radius));
        outline.group = group;
        return outline;
    };
    const Circle hole = domain.circles[1];
    const Overlay around = draw_outlines(sheet, {at(hole.center, hole.radius * 1.05, 0)});
    EXPECT_EQ(around.left_out.at_border, 1) << "an outline about a hole has no inside to cut out";
    EXPECT_TRUE(around.outlines.empty());
    const Overlay across = draw_outlines(sheet, {at(hole.center + hole.radius, 0.5 * hole.radius, 0)});
    EXPECT_EQ(across.left_out.at_border, 1);
    const Overlay two = draw_outlines(sheet, {at({0.0, -0.8}, 0.06, 0), at({0.05, -0.8}, 0.06, 1)});
    EXPECT_EQ(two.left_out.crossing, 1);
    EXPECT_EQ(two.outlines.size(), 1U);
    const Overlay nested = draw_outlines(sheet, {at({0.0, -0.8}, 0.06, 0), at({0.0, -0.8}, 0.03, 1)});
    EXPECT_EQ(nested.outlines.size(), 1U) << "an outline inside another one has no hole of its own";
}

TEST(SphereSheets, ChartsAreTurnedAndTurnedBack)
{
    for (const Complex middle : {Complex(0.5, 0.5), Complex(0.2, 0.9), Complex(1.4, -0.3)})
        for (const Complex place : {Complex(0.5, 0.5), Complex(0.1, 0.3), Complex(2.0, 0.7)}) {
            EXPECT_LT(std::abs(seen_back(middle, seen_from(middle, place)) - place), 1e-13);
            const Complex step(1e-6, 2e-6);
            EXPECT_NEAR(std::abs(seen_from(middle, middle + step)) * magnified(middle), std::abs(step), 1e-11);
            const SpherePoint a = on_sphere(2.0 * middle - Complex(1.0, 1.0));
            const SpherePoint b = on_sphere(2.0 * place - Complex(1.0, 1.0));
            EXPECT_NEAR(2.0 * std::atan(std::abs(seen_from(middle, place))), std::acos(std::min(1.0, a.dot(b))), 1e-7);
        }
    EXPECT_LT((point_at_home(0.2, {0.25, 0.5}) - SpherePoint(0.0, 0.0, 1.0)).norm(), 1e-15);
    EXPECT_LT((point_at_home(0.2, {0.75, 0.5}) - SpherePoint(0.0, 0.0, -1.0)).norm(), 1e-15);
    EXPECT_LT((point_at_home(0.2, {0.45, 0.5}) - point_at_home(0.2, {0.95, 0.5})).norm(), 1e-15);  // at longitude 0
}

TEST(MeetingFaces, CountPairsThatAreNoNeighbours)
{
    Vertices points(8, 3);
    points << 0, 0, 0, 2, 0, 0, 0, 2, 0, 0.3, 0.3, -1, 0.3, 0.3, 1, 5, 5, 0, 0.5, 0.5, 1e-9, 0.5, 0.5, 0;
    Triangles through(2, 3), apart(2, 3), touching(2, 3), above(2, 3);
    through << 0, 1, 2, 3, 4, 5;
    apart << 0, 1, 2, 4, 5, 6;
    touching << 0, 1, 2, 4, 5, 7;
    above << 0, 1, 2, 3, 4, 0;
    const ExecutionContext context;
    EXPECT_EQ(meeting_faces(points, through, context).pairs, 1);
    EXPECT_EQ(meeting_faces(points, through, context).faces, (std::vector<Index>{0, 1}));
    EXPECT_EQ(meeting_faces(points, apart, context).pairs, 0) << "a billionth above is above";
    EXPECT_EQ(meeting_faces(points, touching, context).pairs, 1) << "a corner on a face meets it";
    EXPECT_EQ(meeting_faces(points, above, context).pairs, 0) << "they share a vertex";
}

TEST(MeetingFaces, EndWhereThereAreFarTooMany)
{
    constexpr Index count = 400;  // slabs crosswise: each one meets half of the others
    Vertices points(3 * count, 3);
    Triangles triangles(count, 3);
    for (Index k = 0; k < count; ++k) {
        const double at = 0.001 * k;
        if (k % 2 == 0)
            points.middleRows(3 * k, 3) << at, -1, -1, at, 3, -1, at, -1, 3;
        else
            points.middleRows(3 * k, 3) << -1, at, -1, 3, at, -1, -1, at, 3;
        triangles.row(k) << 3 * k, 3 * k + 1, 3 * k + 2;
    }
    const MeetingFaces meeting = meeting_faces(points, triangles, ExecutionContext());
    EXPECT_FALSE(meeting.all);
    EXPECT_FALSE(meeting.faces.empty());
    CancelToken token;
    token.cancel();
    EXPECT_THROW(meeting_faces(points, triangles, ExecutionContext({}, token)), Cancelled);
}

TEST(Solid, OfAPlaneHasItsVolume)
{
    Vertices square(4, 3), normals(4, 3);
    square << 0, 0, 0, 2, 0, 0, 2, 1, 0, 0, 1, 0;
    normals << 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1;
    Triangles triangles(2, 3);
    triangles << 0, 1, 2, 0, 2, 3;
    const VectorXd half = VectorXd::Constant(4, 0.25);
    const Solid solid = closed_solid(moved_along(square, normals, half, triangles), triangles,
                                     moved_along(square, normals, -half, triangles), triangles, {0, 1, 2, 3});
    EXPECT_NEAR(volume_of(solid.vertices, solid.triangles), 1.0, 1e-15);
    const Surface closed = analyze_surface(solid.triangles, 8);
    EXPECT_EQ(closed.euler_characteristic, 2);
    EXPECT_TRUE(closed.loops.empty() && closed.reoriented.empty());
}

TEST(Solid, NamesTheFacesThatWouldTurnOver)
{
    const auto [vertices, triangles] = cylinder(40, 4, 1.0);
    Vertices normals = vertices;
    normals.col(2).setZero();
    const VectorXd much = VectorXd::Constant(vertices.rows(), -1.5);
    try {
        moved_along(vertices, normals, much, triangles);
        FAIL() << "the inner side is beyond the axis";
    } catch (const InputError& error) {
        EXPECT_EQ(error.elements().size(), static_cast<std::size_t>(triangles.rows()));
    }
}

TEST(Lift, GoesOnOverTheCutOfARing)
{
    const auto mesh = cylinder(60, 20, 2.0);
    const LiftResult result = lifted(mesh, "hexagons", {.shape = LiftShape::ring, .repeats = 12, .perforate = true});
    EXPECT_EQ(result.outlines % 12, 0) << "each row has as many as the next";
    EXPECT_GE(result.outlines, 24);
    EXPECT_EQ(result.loops_after, 2 + result.outlines);
    EXPECT_EQ(result.euler_after, -result.outlines);
    for (std::size_t v = 0; v < result.original.size(); ++v)
        if (const Index own = result.original[v]; own >= 0) {
            EXPECT_TRUE(
                (result.vertices.row(static_cast<Eigen::Index>(v)).array() == mesh.first.row(own).array()).all());
        }
}

TEST(Lift, ARaisedPatternLeavesTheTopology)
{
    const auto mesh = cylinder(60, 20, 2.0);
    const LiftResult result = lifted(mesh, "circles", {.shape = LiftShape::ring, .size = 0.4, .height = 0.1});
    const Surface surface = analyze_surface(result.triangles, static_cast<Index>(result.vertices.rows()));
    EXPECT_EQ(surface.loops.size(), 2U);
    EXPECT_EQ(surface.euler_characteristic, 0);
    EXPECT_TRUE(surface.reoriented.empty());
    const VectorXd radius = result.vertices.leftCols<2>().rowwise().norm();
    EXPECT_NEAR(radius.maxCoeff(), 1.1, 1e-12);
    for (Eigen::Index f = 0; f < result.triangles.rows(); ++f)
        for (const Index v : result.triangles.row(f)) {
            const double facet = std::cos(pi / 60) - 1e-12;  // of the cylinder's chords
            if (result.patch[f] == 0) {
                EXPECT_TRUE(radius[v] >= facet && radius[v] <= 1.0 + 1e-12);
            }
            if (result.patch[f] == 1) {
                EXPECT_GE(radius[v], 0.1 + facet);
            }
        }
}

TEST(Lift, AThickRingHasItsVolume)
{
    const auto mesh = cylinder(120, 20, 2.0);
    const LiftOptions whole{.shape = LiftShape::ring, .size = 0.4, .perforate = true, .thickness = 0.2};
    const LiftResult solid = lifted(mesh, "circles", whole);
    LiftOptions sheet = whole;
    sheet.thickness.reset();
    const LiftResult pierced = lifted(mesh, "circles", sheet);
    double area = 0.0;
    for (Eigen::Index f = 0; f < pierced.triangles.rows(); ++f) {
        const Eigen::RowVector3d a = pierced.vertices.row(pierced.triangles(f, 0));
        const Eigen::RowVector3d b = pierced.vertices.row(pierced.triangles(f, 1)) - a;
        const Eigen::RowVector3d c = pierced.vertices.row(pierced.triangles(f, 2)) - a;
        area += 0.5 * b.cross(c).norm();
    }
    EXPECT_NEAR(volume_of(solid.vertices, solid.triangles) / (0.2 * area), 1.0, 2e-3);
    EXPECT_EQ(solid.outlines, pierced.outlines);
}

TEST(Lift, RefusesWhatItCannotMake)
{
    const auto mesh = cylinder(30, 10, 2.0);
    EXPECT_THROW(lifted(mesh, "circles", {.shape = LiftShape::ring}), InputError);
    EXPECT_THROW(lifted(mesh, "circles", {.shape = LiftShape::ring, .perforate = true, .height = 0.1}), InputError);
    EXPECT_THROW(lifted(mesh, "spirals", {.shape = LiftShape::ring, .perforate = true}), InputError);
    EXPECT_THROW(lifted(mesh, "circles", {.shape = LiftShape::ring, .size = 1e-5, .perforate = true}), InputError);
    EXPECT_THROW(lifted(mesh, "circles", {.shape = LiftShape::ring, .size = 50.0, .perforate = true}), InputError);
    EXPECT_THROW(lifted(mesh, "circles", {.shape = LiftShape::ring, .size = 0.2, .bridge = 0.1, .perforate = true}),
                 InputError);
}
