#include "darts/dart_rounds.h"
#include "darts/darts.h"
#include "even/even_forces.h"
#include "even/even_map.h"
#include "grids.h"
#include "planar/planar_predicates.h"
#include "proxies/carried_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

using namespace koebe;

namespace {

using std::numbers::pi;
constexpr Index rings = 12, around = 48;
constexpr double area_of_cone = 0.25;

/// A cone with this angle round its tip, vertex 0, and its map onto a disk: rings onto rings.
FlatPart cone(double angle)
{
    const double side = std::sqrt(2.0 * area_of_cone / angle);
    const auto at = [](Index ring, Index k) { return 1 + (ring - 1) * around + k % around; };
    Triangles triangles(around * (2 * rings - 1), 3);
    for (Index k = 0; k < around; ++k) triangles.row(k) << 0, at(1, k), at(1, k + 1);
    triangles.bottomRows(2 * around * (rings - 1)) =
        test::grid(rings - 1, around, [&](int i, int j) { return at(i + 1, j); });
    FlatPart part = test::part_of(triangles);
    part.vertices = Vertices::Zero(part.surface.vertex_count, 3);
    part.points = PlanarPoints::Zero(part.surface.vertex_count, 2);
    for (Index ring = 1; ring <= rings; ++ring)
        for (Index k = 0; k < around; ++k) {
            const double r = side * ring / rings, turn = 2.0 * pi * k / around;
            // Of more than a full turn: a saddle, whose rim goes up and down four times.
            const double out = angle < 2.0 * pi ? r * angle / (2.0 * pi) : 0.8 * r;
            const double up = angle < 2.0 * pi ? std::sqrt(r * r - out * out) : 0.45 * r * std::cos(4.0 * turn);
            part.vertices.row(at(ring, k)) << out * std::cos(turn), out * std::sin(turn), up;
            part.points.row(at(ring, k)) << r * std::cos(turn), r * std::sin(turn);
        }
    part.rims.push_back(part.surface.loops.front());
    return part;
}

void relax(FlatPart& part, double even)
{
    std::vector<RoundLoop> free;
    ExecutionContext context;
    make_even({part.vertices, part.surface.triangles, part.surface.loops, part.points, free}, even, packed_side,
              context);
}

EvenForces forces(const FlatPart& part, double even)
{
    return even_forces(part.vertices, part.surface.triangles, part.points, even);
}

double energy(const FlatPart& part, double even) { return forces(part, even).energy.sum(); }

}  // namespace

TEST(Darts, each_face_is_near_a_cut_though_edges_have_no_length)
{
    FlatPart part = cone(1.5 * pi);
    const auto ring = [&](Index r) { return part.vertices.middleRows(1 + (r - 1) * around, around); };
    part.vertices.middleRows(1 + 4 * around, around) = Vertices(ring(6));  // the fifth ring lies on the sixth
    std::vector<std::vector<Index>> halves(2);
    for (Index k = 0; k < around; ++k) halves[2 * k < around ? 0 : 1].push_back(1 + (rings - 1) * around + k);
    const std::vector<int> nearest = nearest_cut(part, halves, std::numeric_limits<double>::infinity());
    for (std::size_t f = 0; f < nearest.size(); ++f) {
        const Index v = part.surface.triangles(static_cast<Eigen::Index>(f), 0);
        const int half = 2 * ((v - 1) % around) < around ? 0 : 1;
        if (v > 0) EXPECT_EQ(nearest[f], half) << f;
        EXPECT_GE(nearest[f], 0) << f;
    }
}

TEST(Darts, one_dart_to_its_tip_lays_a_cone_flat)
{
    constexpr double even = 0.1;
    FlatPart part = cone(1.5 * pi);
    relax(part, even);
    const double before = energy(part, even);
    const std::vector<Dart> darts = promising_darts(part, forces(part, even), even, 1e-3, {});
    ASSERT_EQ(darts.size(), 1U);
    EXPECT_EQ(darts.front().vertices.front(), 0);  // the tip of the dart is that of the cone
    EXPECT_EQ(darts.front().vertices.size(), static_cast<std::size_t>(rings + 1));
    EXPECT_NEAR(darts.front().length, std::sqrt(2.0 * area_of_cone / (1.5 * pi)), 1e-12);
    ASSERT_TRUE(open_darts(part, darts));
    EXPECT_EQ(part.surface.loops.size(), 1U);
    EXPECT_EQ(part.points.rows(), 1 + rings * around + rings);
    EXPECT_EQ(part.surface.loops.front().size(), static_cast<std::size_t>(around + 2 * rings));
    for (Eigen::Index v = 0; v < part.points.rows(); ++v)
        EXPECT_EQ(part.vertices.row(v), cone(1.5 * pi).vertices.row(part.original[v]));
    relax(part, even);
    EXPECT_LT(energy(part, even), 1e-5 * before);
    // The plate's formula is for small strains: here the cone is a quarter of a turn short.
    EXPECT_GT(darts.front().gain, before / 3.0);
    EXPECT_LT(darts.front().gain, before * 3.0);
}

TEST(Darts, where_the_sides_would_have_to_overlap_there_is_none)
{
    FlatPart saddle = cone(2.6 * pi);
    relax(saddle, 0.1);
    for (const Dart& dart : promising_darts(saddle, forces(saddle, 0.1), 0.1, 1e-4, {}))
        EXPECT_NE(dart.vertices.front(), 0);
}

TEST(Darts, none_cuts_a_polygon)
{
    FlatPart whole = cone(1.5 * pi);
    relax(whole, 0.1);
    EXPECT_FALSE(promising_darts(whole, forces(whole, 0.1), 0.1, 1e-3, {}).empty());
    whole.polygon.assign(static_cast<std::size_t>(whole.surface.triangles.rows()), 7);
    EXPECT_TRUE(promising_darts(whole, forces(whole, 0.1), 0.1, 1e-3, {}).empty());
}

// The sector of a disk that the cone is when it lies flat has its arc on a circle.
TEST(Darts, one_that_begins_at_a_round_loop_leaves_both_ends_on_the_circle)
{
    constexpr double even = 0.1;
    const double side = std::sqrt(2.0 * area_of_cone / (1.5 * pi));
    HeldPart part{cone(1.5 * pi), {}};
    const VertexLoop rim = part.flat.surface.loops.front();
    for (const Index v : rim) part.flat.held[v] = 1;
    Track circle;
    circle.circle = {0.0, side};
    part.round.push_back({rim, circle});
    ExecutionContext context;
    const auto relax_held = [&] {
        FlatPart& flat = part.flat;
        make_even({flat.vertices, flat.surface.triangles, flat.surface.loops, flat.points, part.round}, even,
                  packed_side, context);
    };
    relax_held();
    const double before = energy(part.flat, even);
    std::vector<HeldPart> parts{part};
    cut_darts(parts, DartTips::anywhere, even, 1e-4, 1, context);
    part = parts.front();
    relax_held();
    EXPECT_FALSE(part.flat.tips.empty());
    EXPECT_LT(energy(part.flat, even), 1e-3 * before);
    const Circle& round = part.round.front().track.circle;
    EXPECT_EQ(part.round.front().vertices.size(), rim.size() + part.flat.tips.size());
    for (const Index v : part.round.front().vertices)
        EXPECT_NEAR(std::abs(Complex(part.flat.points(v, 0), part.flat.points(v, 1)) - round.center), round.radius,
                    1e-12);
}

// Near the tip of a slender cone faces are strained, in a blunt one they are only bent. Both are as short as a finger.
TEST(Darts, strained_faces_alone_get_them_if_so_asked)
{
    constexpr double even = 0.1;
    ExecutionContext context;
    const auto tips = [&](double angle, DartTips wanted) {
        std::vector<HeldPart> parts{{cone(angle), {}}};
        parts.front().flat.vertices *= 0.1;
        parts.front().flat.points *= 0.1;
        relax(parts.front().flat, even);
        cut_darts(parts, wanted, even, 1e-4, 1, context);
        return parts.front().flat.tips.size();
    };
    EXPECT_GT(tips(1.5 * pi, DartTips::anywhere), 0U);
    EXPECT_EQ(tips(1.5 * pi, DartTips::strained), 0U);
    EXPECT_GT(tips(0.2 * pi, DartTips::strained), 0U);
}

/// A cone as a piece of a mesh, and its proxy.
Proxy proxy_of_cone(const FlatPart& fine, Index faces)
{
    PieceInput input{whole_piece(fine.vertices, fine.surface.triangles)};
    input.seam.assign(fine.surface.twin.size(), 0);
    ExecutionContext context;
    return proxy_of(input, surface_of(input), faces, context);
}

TEST(Proxy, keeps_loops_and_area_and_places_of_vertices)
{
    const FlatPart fine = cone(1.5 * pi);
    const Proxy proxy = proxy_of_cone(fine, 300);
    EXPECT_LE(proxy.surface.triangles.rows(), 300);
    EXPECT_GT(proxy.surface.triangles.rows(), 250);
    EXPECT_EQ(proxy.surface.loops.size(), 1U);
    EXPECT_NEAR(face_areas(proxy.input.piece.vertices, proxy.input.piece.triangles).sum(), area_of_cone, 1e-3);
    for (std::size_t v = 0; v < proxy.coarse.vertex.size(); ++v)
        EXPECT_LT((proxy.coarse.vertices.row(static_cast<Eigen::Index>(v)) - fine.vertices.row(proxy.coarse.vertex[v]))
                      .norm(),
                  0.02)  // a mirrored proxy has vertices beside those of the fine surface, by less than an edge
            << v;
}

// The cuts of a part of the proxy lie in the fine part where they lay, and let it lie flat as they did there.
TEST(CarriedParts, a_dart_lays_the_fine_cone_flat_too)
{
    constexpr double even = 0.1;
    FlatPart fine = cone(1.5 * pi);
    const Proxy proxy = proxy_of_cone(fine, 300);
    FlatPart coarse = test::part_of(proxy.surface.triangles);
    coarse.vertices = proxy.input.piece.vertices;
    coarse.points = fine.points(proxy.coarse.vertex, Eigen::all);
    relax(fine, even);
    const double before = energy(fine, even);
    ExecutionContext context;
    std::vector<HeldPart> cut{{coarse, {}}};
    relax(cut.front().flat, even);
    cut_darts(cut, DartTips::anywhere, even, 1e-3, 1, context);
    relax(cut.front().flat, even);
    const FlatPart& after = cut.front().flat;
    ASSERT_EQ(after.tips.size(), 1U);
    EXPECT_EQ(proxy.coarse.vertex[after.original[after.tips.front()]], 0);
    std::vector<FlatPart> carried = carried_parts(proxy, {after}, 1, context);
    ASSERT_EQ(carried.size(), 1U);
    FlatPart& part = carried.front();
    EXPECT_TRUE(part.is_near);
    EXPECT_EQ(part.faces, fine.faces);
    EXPECT_EQ(part.surface.loops.size(), 1U);
    ASSERT_EQ(part.tips.size(), 1U);
    EXPECT_EQ(part.original[part.tips.front()], 0);
    EXPECT_NEAR(part.dart_length, std::sqrt(2.0 * area_of_cone / (1.5 * pi)), 0.25 * part.dart_length);
    EXPECT_TRUE(lies_one_to_one(part, part.points));
    EXPECT_LT(energy(part, even), 0.2 * before);  // it starts near the end,
    relax(part, even);
    EXPECT_LT(energy(part, even), 1e-5 * before);  // and reaches it
}

/// Some faces of a proxy as a part, without places in the plane.
FlatPart part_of_faces(const Proxy& proxy, const std::vector<Index>& faces)
{
    FlatPart part;
    part.faces = faces;
    std::vector<Index> name(proxy.coarse.vertex.size(), -1);
    Triangles triangles(static_cast<Eigen::Index>(faces.size()), 3);
    for (std::size_t i = 0; i < faces.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const Index v = proxy.surface.triangles(faces[i], k);
            if (name[v] < 0) {
                name[v] = static_cast<Index>(part.original.size());
                part.original.push_back(v);
            }
            triangles(static_cast<Eigen::Index>(i), k) = name[v];
        }
    part.surface = analyze_surface(triangles, static_cast<Index>(part.original.size()));
    return part;
}

TEST(CarriedParts, borders_of_a_proxy_s_parts_become_fine_ones_as_long)
{
    const FlatPart fine = cone(1.5 * pi);
    const Proxy proxy = proxy_of_cone(fine, 300);
    const double side = std::sqrt(2.0 * area_of_cone / (1.5 * pi));
    std::vector<std::vector<Index>> faces(2);
    double coarse_border = 0.0;
    std::vector<int> label;
    for (const auto& face : proxy.surface.triangles.rowwise()) {
        Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
        for (const Index v : face) middle += proxy.coarse.vertices.row(v) / 3.0;
        label.push_back(middle.norm() < 0.6 * side ? 0 : 1);
        faces[label.back()].push_back(static_cast<Index>(label.size() - 1));
    }
    const auto border = [](const Surface& surface, const Vertices& vertices, const std::vector<int>& own) {
        double sum = 0.0;
        for (Index h = 0; h < static_cast<Index>(surface.twin.size()); ++h)
            if (surface.twin[h] >= 0 && own[h / 3] < own[surface.twin[h] / 3])
                sum += (vertices.row(surface.triangles(h / 3, h % 3)) -
                        vertices.row(surface.triangles(h / 3, (h + 1) % 3)))
                           .norm();
        return sum;
    };
    coarse_border = border(proxy.surface, proxy.coarse.vertices, label);
    ExecutionContext context;
    const std::vector<std::vector<Index>> carried =
        carried_faces(proxy, {part_of_faces(proxy, faces[0]), part_of_faces(proxy, faces[1])}, context);
    ASSERT_EQ(carried.size(), 2U);
    EXPECT_EQ(carried[0].size() + carried[1].size(), fine.faces.size());
    std::vector<int> own(fine.faces.size(), 1);
    for (const Index f : carried[0]) own[f] = 0;
    for (std::size_t f = 0; f < own.size(); ++f) {
        double off = 0.0;
        for (int k = 0; k < 3; ++k)
            off += fine.vertices.row(fine.surface.triangles(static_cast<Eigen::Index>(f), k)).norm() / 3.0;
        if (std::abs(off / side - 0.6) > 0.2) {
            EXPECT_EQ(own[f], off < 0.6 * side ? 0 : 1) << f;
        }
    }
    EXPECT_NEAR(border(fine.surface, fine.vertices, own), coarse_border, 0.15 * coarse_border);
}
