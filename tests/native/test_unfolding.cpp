// Laws of unfolding: lengths stay, nothing overlaps, and the cuts of simple solids are known.
#include "hard/unfolding.h"

#include "core/connectivity.h"
#include "flat/noise_level.h"
#include "mesh/topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>
#include <vector>

namespace koebe {
namespace {

struct Solid {
    std::vector<Eigen::RowVector3d> points;
    std::vector<std::vector<Index>> polygons;
};

/// A surface of area 1, times the square of the scale, with triangles in place of the polygons.
CutSurface surface_of(const Solid& solid, double scale = 1.0)
{
    Vertices vertices(static_cast<Eigen::Index>(solid.points.size()), 3);
    for (std::size_t v = 0; v < solid.points.size(); ++v) vertices.row(static_cast<Eigen::Index>(v)) = solid.points[v];
    std::vector<std::array<Index, 3>> corners;
    std::vector<Index> polygon;
    for (std::size_t p = 0; p < solid.polygons.size(); ++p)
        for (std::size_t k = 1; k + 1 < solid.polygons[p].size(); ++k) {
            corners.push_back({solid.polygons[p][0], solid.polygons[p][k], solid.polygons[p][k + 1]});
            polygon.push_back(static_cast<Index>(p));
        }
    Triangles triangles(static_cast<Eigen::Index>(corners.size()), 3);
    for (std::size_t f = 0; f < corners.size(); ++f)
        triangles.row(static_cast<Eigen::Index>(f)) << corners[f][0], corners[f][1], corners[f][2];
    const Vertices scaled = scale / std::sqrt(face_areas(vertices, triangles).sum()) * vertices;
    return cut_surface(scaled, analyze_surface(triangles, static_cast<Index>(vertices.rows())), polygon);
}

/// A box of n^2 quadrilaterals a side.
Solid box(double a, double b, double c, int n)
{
    Solid solid;
    std::map<std::tuple<int, int, int>, Index> number;
    const auto vertex = [&](std::array<int, 3> at) {
        const auto [found, is_new] = number.try_emplace({at[0], at[1], at[2]}, static_cast<Index>(solid.points.size()));
        if (is_new) solid.points.emplace_back(a * at[0] / n, b * at[1] / n, c * at[2] / n);
        return found->second;
    };
    for (int axis = 0; axis < 3; ++axis)
        for (const int side : {0, n})
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j) {
                    std::vector<Index> quad;
                    for (const auto& [di, dj] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
                        std::array<int, 3> at{};
                        at[axis] = side;
                        at[(axis + 1) % 3] = i + di;
                        at[(axis + 2) % 3] = j + dj;
                        quad.push_back(vertex(at));
                    }
                    if (side == 0) std::swap(quad[1], quad[3]);
                    solid.polygons.push_back(quad);
                }
    return solid;
}

/// A prism of m sides in so many rings, round the unit circle, with a bottom. The top is flat, or a cone of this
/// height.
Solid prism(int m, double height, int rings, double cone)
{
    Solid solid;
    for (int k = 0; k <= rings; ++k)
        for (int i = 0; i < m; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / m;
            solid.points.emplace_back(std::cos(angle), std::sin(angle), height * k / rings);
        }
    std::vector<Index> bottom, top;
    for (Index i = 0; i < m; ++i) {
        const Index next = (i + 1) % m;
        for (Index k = 0; k < rings; ++k)
            solid.polygons.push_back({k * m + i, k * m + next, (k + 1) * m + next, (k + 1) * m + i});
        bottom.insert(bottom.begin(), i);
        top.push_back(rings * m + i);
        if (cone > 0.0) solid.polygons.push_back({rings * m + i, rings * m + next, (rings + 1) * m});
    }
    solid.polygons.push_back(bottom);
    if (cone > 0.0)
        solid.points.emplace_back(0.0, 0.0, height + cone);
    else
        solid.polygons.push_back(top);
    return solid;
}

std::optional<UnfoldedParts> unfold(const CutSurface& surface)
{
    ExecutionContext context;
    return unfolded(surface, context);
}

/// The length of all cuts of a closed surface, after a check that faces keep their lengths, that parts are one to one,
/// and that each face is in one part.
double cuts_of(const CutSurface& surface, const UnfoldedParts& unfolded)
{
    double boundary = 0.0;
    std::vector<int> seen(static_cast<std::size_t>(surface.areas.size()), 0);
    for (const FlatPart& part : unfolded.parts) {
        EXPECT_TRUE(lies_one_to_one(part, part.points));
        const Triangles& triangles = part.surface.triangles;
        for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h) {
            const Index a = origin(triangles, h), b = target(triangles, h);
            const double length = (part.points.row(a) - part.points.row(b)).norm();
            EXPECT_NEAR(length, surface.lengths[3 * part.faces[face_of(h)] + h % 3], 1e-12);
            if (part.surface.twin[h] == no_twin) boundary += length;
        }
        for (const Index f : part.faces) ++seen[f];
    }
    EXPECT_EQ(seen, std::vector<int>(seen.size(), 1));
    EXPECT_NEAR(0.5 * boundary, unfolded.cut_length, 1e-12);
    return unfolded.cut_length;
}

/// A square frame of nine cells a side, without the cell in the middle: a surface with a handle.
Solid frame(double height)
{
    Solid solid;
    for (const double z : {0.0, height})
        for (int i = 0; i < 16; ++i) solid.points.emplace_back(i / 4, i % 4, z);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const Index v = 4 * i + j;
            if (i == 1 && j == 1) continue;
            solid.polygons.push_back({v, v + 1, v + 5, v + 4});
            solid.polygons.push_back({v + 16, v + 20, v + 21, v + 17});
        }
    const std::vector<Index> outer{0, 4, 8, 12, 13, 14, 15, 11, 7, 3, 2, 1}, inner{5, 6, 10, 9};
    for (const auto& ring : {outer, inner})
        for (std::size_t k = 0; k < ring.size(); ++k) {
            const Index a = ring[k], b = ring[(k + 1) % ring.size()];
            solid.polygons.push_back({a, b, b + 16, a + 16});
        }
    return solid;
}

/// The largest change of a distance between corners of the faces with this normal and height over the origin, which
/// must lie in one part.
double most_bent(const CutSurface& surface, const UnfoldedParts& unfolded, const Eigen::RowVector3d& normal,
                 double height, double tolerance = 1e-12)
{
    double most = 0.0;
    int parts = 0;
    for (const FlatPart& part : unfolded.parts) {
        std::vector<Index> own;
        for (Eigen::Index f = 0; f < part.surface.triangles.rows(); ++f) {
            bool is_in = true;
            for (int k = 0; k < 3; ++k)
                is_in &= std::abs(part.vertices.row(part.surface.triangles(f, k)).dot(normal) - height) < tolerance;
            if (!is_in) continue;
            for (int k = 0; k < 3; ++k) own.push_back(part.surface.triangles(f, k));
        }
        if (own.empty()) continue;
        ++parts;
        for (const Index a : own)
            for (const Index b : own)
                most = std::max(most, std::abs((part.points.row(a) - part.points.row(b)).norm() -
                                               (part.vertices.row(a) - part.vertices.row(b)).norm()));
    }
    EXPECT_EQ(parts, 1);
    EXPECT_GT(surface.areas.sum(), 0.0);
    return most;
}

std::optional<UnfoldedParts> unfold_hard(const CutSurface& surface)
{
    ExecutionContext context;
    return hard_parts(surface, context);
}

TEST(Unfolding, APlateWithAHoleStaysWholeAlthoughItsSurfaceHasAHandle)
{
    const CutSurface surface = surface_of(frame(0.5));
    ASSERT_EQ(surface.surface.genus, 1);
    const auto parts = unfold_hard(surface);
    ASSERT_TRUE(parts);
    EXPECT_TRUE(parts->rest.empty());
    cuts_of(surface, *parts);
    const double top = surface.vertices.col(2).maxCoeff();
    EXPECT_LT(most_bent(surface, *parts, Eigen::RowVector3d::UnitZ(), 0.0), 1e-12);
    EXPECT_LT(most_bent(surface, *parts, Eigen::RowVector3d::UnitZ(), top), 1e-12);
}

TEST(Unfolding, APlateStaysFlatRoundADent)
{
    Solid dented = box(1.0, 1.0, 1.0, 6);
    for (auto& point : dented.points)
        if ((point - Eigen::RowVector3d(0.5, 0.5, 1.0)).norm() < 1e-9) point[2] -= 0.02;
    const CutSurface surface = surface_of(dented);
    const auto parts = unfold_hard(surface);
    ASSERT_TRUE(parts);
    std::size_t faces = parts->rest.size();
    for (const FlatPart& part : parts->parts) {
        EXPECT_TRUE(lies_one_to_one(part, part.points));
        faces += part.faces.size();
    }
    EXPECT_EQ(faces, static_cast<std::size_t>(surface.areas.size()));
    EXPECT_LE(parts->rest.size(), 8u);  // the faces round the dent at most
    const double side = surface.vertices.col(2).maxCoeff();
    for (int axis = 0; axis < 3; ++axis)
        for (const double height : {0.0, side})
            EXPECT_LT(most_bent(surface, *parts, Eigen::RowVector3d::Unit(axis), height), 1e-12);
}

void add_noise(Solid& solid, double noise)
{
    for (std::size_t v = 0; v < solid.points.size(); ++v)
        for (int axis = 0; axis < 3; ++axis)
            solid.points[v][axis] += noise * std::sin(1e3 * static_cast<double>(3 * v + axis + 1));
}

TEST(Unfolding, NoiseDoesNotHideTheSidesOfABox)
{
    Solid rough = box(1.0, 1.5, 2.0, 8);
    add_noise(rough, 2e-3);
    const CutSurface surface = surface_of(rough);
    const auto parts = unfold_hard(surface);
    ASSERT_TRUE(parts);
    EXPECT_TRUE(parts->rest.empty());
    for (const FlatPart& part : parts->parts) EXPECT_TRUE(lies_one_to_one(part, part.points));
    const double noise = 2e-3 * surface.vertices.col(2).maxCoeff() / 2.0;
    EXPECT_LT(most_bent(surface, *parts, Eigen::RowVector3d::UnitZ(), 0.0, 1.5 * noise), 8.0 * noise);
}

/// A ball of radius 1 cut by a plane at this height: a plate with so many rings.
Solid ball_with_plate(double height, int plate_rings)
{
    constexpr int n = 40;
    Solid ball;
    std::vector<std::vector<Index>> rings;
    const auto add_ring = [&](double radius, double at) {
        rings.emplace_back();
        for (int k = 0; k < n; ++k) {
            const double turn = 2.0 * std::numbers::pi * k / n;
            rings.back().push_back(static_cast<Index>(ball.points.size()));
            ball.points.emplace_back(radius * std::cos(turn), radius * std::sin(turn), at);
        }
    };
    for (int i = 1; i <= plate_rings; ++i) add_ring(std::sqrt(1.0 - height * height) * i / plate_rings, height);
    for (int i = 1; i < 18; ++i) {
        const double down = std::acos(height) * (1.0 - i / 18.0);
        add_ring(std::sin(down), std::cos(down));
    }
    for (const double end : {height, 1.0}) ball.points.emplace_back(0.0, 0.0, end);
    const Index top = static_cast<Index>(ball.points.size()) - 1;
    for (int k = 0; k < n; ++k) {
        const int next = (k + 1) % n;
        ball.polygons.push_back({top - 1, rings[0][next], rings[0][k]});
        for (std::size_t i = 0; i + 1 < rings.size(); ++i)
            ball.polygons.push_back({rings[i][k], rings[i][next], rings[i + 1][next], rings[i + 1][k]});
        ball.polygons.push_back({rings.back()[k], rings.back()[next], top});
    }
    return ball;
}

TEST(Unfolding, ASmallPlateOfABallStaysFlat)
{
    for (const double height : {-0.5, -0.75}) {
        const CutSurface surface = surface_of(ball_with_plate(height, 6));
        const auto parts = unfold_hard(surface);
        ASSERT_TRUE(parts);
        ASSERT_EQ(parts->parts.size(), 1u);
        const double low = surface.vertices.col(2).minCoeff();
        EXPECT_LT(most_bent(surface, *parts, Eigen::RowVector3d::UnitZ(), low), 1e-12);
        EXPECT_EQ(parts->rest.size(), surface.areas.size() - parts->parts.front().faces.size());
    }
}

TEST(Unfolding, NoiseIsFoundOnASmallPlateOfABall)
{
    // The plate is a fifth of the area, or a tenth.
    for (const auto& [height, noise, share] : {std::tuple(-0.5, 1e-4, 0.2), std::tuple(-0.75, 1e-4, 0.111)}) {
        Solid ball = ball_with_plate(height, 6);
        add_noise(ball, noise);
        const PlanarRegions regions = planar_regions(surface_of(ball));
        EXPECT_GT(regions.noise, 0.0);
        double largest = 0.0;
        for (const RegionPlane& plane : regions.planes) largest = std::max(largest, plane.area);
        EXPECT_NEAR(largest, share, 0.01) << height << " " << noise;
    }
}

TEST(Unfolding, RoughFacesBesideExactPlanesAreNoNoise)
{
    Solid rough = box(1.0, 1.0, 1.0, 8);
    for (std::size_t v = 0; v < rough.points.size(); ++v)
        if (std::abs(rough.points[v][2] - 0.5) < 0.49)
            for (int axis = 0; axis < 2; ++axis)
                rough.points[v][axis] += 2e-3 * std::sin(1e3 * static_cast<double>(3 * v + axis + 1));
    EXPECT_EQ(planar_regions(surface_of(rough)).noise, 0.0);
}

TEST(Unfolding, APlaneThatTouchesItselfInAVertexStaysWhole)
{
    // Two pyramids stand on a floor, and meet in a corner.
    Solid solid;
    for (int i = 0; i < 25; ++i) solid.points.emplace_back(i / 5, i % 5, 0.0);
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
            const std::vector<Index> square{5 * i + j, 5 * i + j + 5, 5 * i + j + 6, 5 * i + j + 1};
            if (i != j || i == 0 || i == 3) {
                solid.polygons.push_back(square);
                continue;
            }
            const Index apex = static_cast<Index>(solid.points.size());
            solid.points.emplace_back(i + 0.5, j + 0.5, 0.8);
            for (std::size_t k = 0; k < 4; ++k) solid.polygons.push_back({square[k], square[(k + 1) % 4], apex});
        }
    const CutSurface surface = surface_of(solid);
    const auto parts = unfold_hard(surface);
    ASSERT_TRUE(parts);
    EXPECT_TRUE(parts->rest.empty());
    for (const FlatPart& part : parts->parts) EXPECT_TRUE(lies_one_to_one(part, part.points));
    EXPECT_LT(most_bent(surface, *parts, Eigen::RowVector3d::UnitZ(), 0.0), 1e-3);
}

TEST(Unfolding, AnEdgeWithoutLengthBetweenTwoSidesCutsNothing)
{
    // In the middle of an edge lie two vertices, and each side has a needle between them.
    Solid solid = box(1.0, 1.0, 1.0, 1);
    const Index a = solid.polygons[0][0], b = solid.polygons[0][1], middle = static_cast<Index>(solid.points.size());
    for (int i = 0; i < 2; ++i) solid.points.push_back((solid.points[a] + solid.points[b]) / 2.0);
    for (auto& polygon : solid.polygons)
        for (std::size_t k = 0; k < 4; ++k) {
            const Index from = polygon[k], to = polygon[(k + 1) % 4];
            if (std::minmax(from, to) != std::minmax(a, b)) continue;
            std::rotate(polygon.begin(), polygon.begin() + static_cast<std::ptrdiff_t>((k + 2) % 4), polygon.end());
            polygon.insert(polygon.end() - 1, {middle + (from == b), middle + (from == a)});
            break;
        }
    const auto parts = unfold(surface_of(solid));
    ASSERT_TRUE(parts);
    EXPECT_EQ(parts->parts.size(), 1u);
    EXPECT_NEAR(parts->cut_length, 7.0 / std::sqrt(6.0), 1e-5);
    for (const FlatPart& part : parts->parts) EXPECT_TRUE(lies_one_to_one(part, part.points));
}

TEST(Unfolding, SliversThatNoiseTurnsOverStayInTheirPlanes)
{
    // Two rows of vertices nearly meet, and noise moves them through each other.
    Solid rough = box(1.0, 1.5, 2.0, 8);
    for (std::size_t v = 0; v < rough.points.size(); ++v) {
        if (std::abs(rough.points[v][0] - 0.375) < 1e-9) rough.points[v][0] = 0.25 + 1e-4;
    }
    add_noise(rough, 1e-3);
    const CutSurface surface = surface_of(rough);
    const auto parts = unfold_hard(surface);
    ASSERT_TRUE(parts);
    EXPECT_GT(parts->noise, 0.0);
    EXPECT_TRUE(parts->rest.empty());
    for (const FlatPart& part : parts->parts) EXPECT_TRUE(lies_one_to_one(part, part.points));
}

TEST(Unfolding, ABallIsNotHard)
{
    for (const int n : {3, 8}) {
        Solid ball = box(1.0, 1.0, 1.0, n);
        for (auto& point : ball.points) point = (point.array() - 0.5).matrix().normalized();
        EXPECT_FALSE(unfold_hard(surface_of(ball)));
    }
}

TEST(Unfolding, ACubeBecomesACrossCutAlongSevenEdges)
{
    for (const int n : {1, 2, 7}) {
        const CutSurface cube = surface_of(box(1.0, 1.0, 1.0, n));
        const auto parts = unfold(cube);
        ASSERT_TRUE(parts);
        EXPECT_EQ(parts->parts.size(), 1u);
        EXPECT_NEAR(cuts_of(cube, *parts), 7.0 / std::sqrt(6.0), 1e-12);
    }
}

TEST(Unfolding, ABoxIsCutAlongItsShortEdges)
{
    const CutSurface slab = surface_of(box(1.0, 2.0, 4.0, 3));
    const auto parts = unfold(slab);
    ASSERT_TRUE(parts);
    // Of twelve edges five join the six sides: the longest that make no ring.
    EXPECT_NEAR(cuts_of(slab, *parts), (4.0 * 7.0 - (3.0 * 4.0 + 2.0 * 2.0)) / std::sqrt(28.0), 1e-12);
}

TEST(Unfolding, ARoundSideIsSlitAndItsEndsComeOff)
{
    const int m = 40;
    const double rim = 2.0 * m * std::sin(std::numbers::pi / m), end = m * std::sin(2.0 * std::numbers::pi / m) / 2.0;
    const CutSurface tin = surface_of(prism(m, 3.0, 5, 0.0));
    const auto parts = unfold(tin);
    ASSERT_TRUE(parts);
    EXPECT_EQ(parts->parts.size(), 3u);
    EXPECT_NEAR(cuts_of(tin, *parts), (2.0 * rim + 3.0) / std::sqrt(3.0 * rim + 2.0 * end), 1e-12);
    double slit = 0.0;
    for (const FlatPart& part : parts->parts) slit += part.slit;
    EXPECT_NEAR(slit, 3.0 / std::sqrt(3.0 * rim + 2.0 * end), 1e-12);
}

/// The parts of a solid, after their lengths and cuts have been checked.
std::vector<FlatPart> expect_parts(const Solid& solid, std::size_t count)
{
    const CutSurface surface = surface_of(solid);
    const auto parts = unfold(surface);
    EXPECT_TRUE(parts);
    if (!parts) return {};
    EXPECT_EQ(parts->parts.size(), count);
    cuts_of(surface, *parts);
    return parts->parts;
}

TEST(Unfolding, APrismOfFewSidesKeepsItsEnds) { expect_parts(prism(6, 1.0, 2, 0.0), 1); }

TEST(Unfolding, AConeIsSlitToItsTip)
{
    const std::vector<FlatPart> parts = expect_parts(prism(48, 2.0, 1, 1.0), 3);
    std::size_t tips = 0;
    double darts = 0.0;
    for (const FlatPart& part : parts) {
        tips += part.tips.size();
        darts += part.dart_length;
    }
    EXPECT_EQ(tips, 1u);
    const double end = 24.0 * std::sin(std::numbers::pi / 24.0), half_side = std::sin(std::numbers::pi / 48.0);
    const double area = 96.0 * half_side * 2.0 + end + 48.0 * half_side * std::sqrt(2.0 - half_side * half_side);
    EXPECT_NEAR(darts, std::sqrt(2.0 / area), 1e-12);  // the cone's side is as long as the root of 2
}

/// A lid: a square plate, and round it strips bent down by an eighth of a right angle, with triangles at the corners.
Solid bevelled_lid(double width)
{
    Solid solid;
    const double low = -width * std::tan(std::numbers::pi / 8.0);
    const std::pair<int, int> corners[] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    for (const auto& [x, y] : corners) solid.points.emplace_back(x, y, 0.0);
    for (Index k = 0; k < 4; ++k) {  // of each side the ends of its strip
        const auto [x, y] = corners[k];
        const bool along_y = k % 2 == 0;
        solid.points.emplace_back(along_y ? x : x * (1.0 + width), along_y ? y * (1.0 + width) : y, low);
        const auto [next_x, next_y] = corners[(k + 1) % 4];
        solid.points.emplace_back(along_y ? next_x : next_x * (1.0 + width), along_y ? next_y * (1.0 + width) : next_y,
                                  low);
    }
    solid.polygons.push_back({0, 1, 2, 3});
    for (Index k = 0; k < 4; ++k) {
        const Index next = (k + 1) % 4;
        solid.polygons.push_back({next, k, 4 + 2 * k, 5 + 2 * k});
        solid.polygons.push_back({next, 5 + 2 * k, 4 + 2 * next});
    }
    return solid;
}

TEST(Unfolding, StripsOfABevelStayAtTheirPlate)
{
    const CutSurface surface = surface_of(bevelled_lid(0.05));
    const auto parts = unfold_hard(surface);
    ASSERT_TRUE(parts);
    EXPECT_TRUE(parts->rest.empty());
    ASSERT_EQ(parts->parts.size(), 1u);  // before, the strips left the plate, and followed each other
    EXPECT_TRUE(lies_one_to_one(parts->parts.front(), parts->parts.front().points));
    EXPECT_LT(parts->cut_length, 0.25 * surface.lengths.maxCoeff());  // the corners, no side of the plate
}

TEST(Unfolding, WhatIsCurvedBothWaysIsLeft)
{
    Solid ball = box(1.0, 1.0, 1.0, 8);
    for (auto& point : ball.points) point = (point.array() - 0.5).matrix().normalized();
    for (const double scale : {1.0, 1e-7}) EXPECT_FALSE(unfold(surface_of(ball, scale)));
    Solid dented = box(1.0, 1.0, 1.0, 6);
    for (auto& point : dented.points)
        if ((point.head<2>().array() == 0.5).all()) point[2] += 0.02;
    EXPECT_FALSE(unfold(surface_of(dented)));
}

}  // namespace
}  // namespace koebe
