#include "core/errors.h"
#include "cost/tuning.h"
#include "cut_samples.h"
#include "flat/flat_part.h"
#include "flat/free_rims.h"
#include "part_maps/texel_evenness.h"
#include "parts/parts.h"
#include "pipeline/uniformize.h"
#include "quality/distortion.h"
#include "quality/stored_uv.h"
#include "splitting/coarse_surface.h"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>

using namespace koebe;
using namespace koebe::test;

namespace {

PartsResult parts(const Mesh& mesh, const PartsOptions& options = {})
{
    ExecutionContext context;
    return parts_of(mesh.vertices, mesh.triangles, options, context);
}

Eigen::Matrix<double, 3, 2> stored_face(const PartsResult& result, Eigen::Index f)
{
    return result.uv.middleRows(3 * f, 3).unaryExpr(&as_stored);
}

double cross(const Eigen::RowVector2d& a, const Eigen::RowVector2d& b) { return a[0] * b[1] - a[1] * b[0]; }

/// Faces that are not upright as stored.
Index upside_down(const PartsResult& result)
{
    Index count = 0;
    for (Eigen::Index f = 0; f < result.uv.rows() / 3; ++f) {
        const auto p = stored_face(result, f);
        count += !(cross(p.row(1) - p.row(0), p.row(2) - p.row(0)) > 0.0);
    }
    return count;
}

/// The most faces that lie over one of many points.
int most_layers(const PartsResult& result)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(0.0, 1.0);
    int most = 0;
    for (int i = 0; i < 3000; ++i) {
        const Eigen::RowVector2d x(place(random), place(random));
        int layers = 0;
        for (Eigen::Index f = 0; f < result.uv.rows() / 3; ++f) {
            const auto p = stored_face(result, f);
            layers += cross(p.row(1) - p.row(0), x - p.row(0)) > 0.0 &&
                      cross(p.row(2) - p.row(1), x - p.row(1)) > 0.0 && cross(p.row(0) - p.row(2), x - p.row(2)) > 0.0;
        }
        most = std::max(most, layers);
    }
    return most;
}

void expect_sound(const PartsResult& result, Index faces)
{
    ASSERT_EQ(result.uv.rows(), 3 * faces);
    EXPECT_TRUE(result.uv.allFinite());
    EXPECT_GE(result.uv.minCoeff(), 0.0);
    EXPECT_LE(result.uv.maxCoeff(), 1.0);
    std::vector<int> times(faces, 0);
    for (std::size_t k = 0; k < result.parts.size(); ++k)
        for (const Index f : result.parts[k].faces) {
            ++times[f];
            EXPECT_EQ(result.part[f], static_cast<Index>(k));
        }
    EXPECT_EQ(std::ranges::count(times, 1), faces);
    EXPECT_EQ(static_cast<Index>(result.distortion.flipped.size()), upside_down(result));
    EXPECT_EQ(result.distortion.flipped.size(), 0U);
    EXPECT_EQ(most_layers(result), 1);
}

}  // namespace

TEST(Parts, finger_becomes_a_tube_and_a_cap)
{
    const Mesh mesh = finger();
    const PartsResult result = parts(mesh, {.darts = 0.0});
    expect_sound(result, static_cast<Index>(mesh.triangles.rows()));
    ASSERT_EQ(result.parts.size(), 2U);
    EXPECT_EQ(result.parts[0].kind, PartKind::tube);
    EXPECT_EQ(result.parts[1].kind, PartKind::disk);
    EXPECT_EQ(result.parts[0].loops.size(), 2U);
    EXPECT_LT(result.density_ratio_5_95, 1.25);
    EXPECT_GT(result.even_area, 0.99);
    // The girth once, and the slit.
    const double area = 2.0 * pi * 11.0;
    EXPECT_NEAR(result.cut_length - result.slit_length, 2.0 * pi / std::sqrt(area), 0.05);
    EXPECT_NEAR(result.slit_length, 10.0 / std::sqrt(area), 0.15);
}

/// The finger with its vertices off their places, so that no ring of edges is straight.
Mesh rough_finger(double length = 10.0, int around = 24, unsigned seed = 3)
{
    Mesh mesh = finger(length, around);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> off(-0.3, 0.3);
    for (Eigen::Index v = around; v < mesh.vertices.rows(); ++v) {
        const double angle = std::atan2(mesh.vertices(v, 1), mesh.vertices(v, 0)) + off(random) * 2.0 * pi / around;
        const double radius = mesh.vertices.row(v).head<2>().norm();
        const double height = mesh.vertices(v, 2) + off(random) * 2.0 * pi / around;
        mesh.vertices.row(v) << radius * std::cos(angle), radius * std::sin(angle), height;
    }
    return mesh;
}

/// Of each loop of a part, its distance from a straight line across the UVs (tubes) or a circle, over the radius.
std::vector<double> off_round_by_hand(const Mesh& mesh, const PartsResult& result, const PartReport& part)
{
    std::vector<double> off;
    for (const VertexLoop& loop : part.loops) {
        std::vector<Eigen::RowVector2d> at;
        for (const Index f : part.faces)
            for (int k = 0; k < 3; ++k)
                if (std::ranges::count(loop, mesh.triangles(f, k)) > 0) at.emplace_back(stored_face(result, f).row(k));
        if (part.kind == PartKind::tube) {
            const auto width = [&](int axis) {
                const auto [low, high] = std::ranges::minmax(at, {}, [&](const auto& p) { return p[axis]; });
                return high[axis] - low[axis];
            };
            off.push_back(pi * std::min(width(0), width(1)) / std::max(width(0), width(1)));
            continue;
        }
        // The circle of least squares, from x^2 + y^2 = 2 a x + 2 b y + c.
        Eigen::MatrixX3d rows(at.size(), 3);
        Eigen::VectorXd right(at.size());
        for (std::size_t i = 0; i < at.size(); ++i) {
            rows.row(static_cast<Eigen::Index>(i)) << 2.0 * at[i][0], 2.0 * at[i][1], 1.0;
            right[static_cast<Eigen::Index>(i)] = at[i].squaredNorm();
        }
        const Eigen::Vector3d x = rows.colPivHouseholderQr().solve(right);
        const double radius = std::sqrt(x[2] + x.head<2>().squaredNorm());
        double most = 0.0;
        for (const auto& p : at)
            most = std::max(most, std::abs((p - x.head<2>().transpose()).norm() - radius) / radius);
        off.push_back(most);
    }
    return off;
}

TEST(Parts, rims_at_cuts_follow_the_edges_and_own_loops_are_round)
{
    const Mesh mesh = rough_finger();
    PartsOptions options{.price = 0.001, .loops = LoopForm::round};
    const PartsResult free = parts(mesh, options);
    options.round_cuts = true;
    const PartsResult round = parts(mesh, options);
    EXPECT_EQ(free.part, round.part);
    EXPECT_GE(free.parts.size(), 2U);
    EXPECT_LT(free.distortion.angle_error_deg.mean, round.distortion.angle_error_deg.mean);
    EXPECT_LT(free.parts[0].angle_error_deg, 0.7 * round.parts[0].angle_error_deg);  // the tube has no other
    for (const PartsResult* result : {&free, &round}) {
        expect_sound(*result, static_cast<Index>(mesh.triangles.rows()));
        for (const PartReport& part : result->parts) {
            const std::vector<double> by_hand = off_round_by_hand(mesh, *result, part);
            ASSERT_EQ(part.off_round.size(), part.loops.size());
            for (std::size_t k = 0; k < part.loops.size(); ++k) {
                EXPECT_NEAR(part.off_round[k], by_hand[k], 0.15 * by_hand[k] + 1e-5);  // another circle
                const bool is_own = part.loops[k].front() < 24;                        // the finger's open end
                if (is_own || result == &round)
                    EXPECT_LT(part.off_round[k], 1e-4);
                else
                    EXPECT_GT(part.off_round[k], 1e-2);
            }
        }
    }
}

TEST(Parts, a_boundary_that_two_sides_share_is_a_cut)
{
    // The finger, its vertices doubled along a ring: what a seam in another program is.
    Mesh mesh = rough_finger();
    const Index count = static_cast<Index>(mesh.vertices.rows()), first = 20 * 24, last = first + 24;
    mesh.vertices.conservativeResize(count + 24, Eigen::NoChange);
    mesh.vertices.bottomRows(24) = mesh.vertices.middleRows(first, 24).eval();
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
        if (mesh.triangles.row(f).maxCoeff() >= last)
            for (Index& v : mesh.triangles.row(f))
                if (v >= first && v < last) v += count - first;
    const PartsResult result = parts(mesh, {.price = 0.01, .loops = LoopForm::round});
    expect_sound(result, static_cast<Index>(mesh.triangles.rows()));
    double widest = 0.0;
    for (const PartReport& part : result.parts)
        for (std::size_t k = 0; k < part.loops.size(); ++k)
            if (part.loops[k].front() < 24)
                EXPECT_LT(part.off_round[k], 1e-4);
            else
                widest = std::max(widest, part.off_round[k]);
    EXPECT_GT(widest, 1e-2);
}

TEST(FreeRims, undo_the_circle_of_a_zigzag_and_leave_what_is_held)
{
    // A plane of equilateral triangles; those within a circle have a zigzag rim. Their map is the circle with the rim
    // on it; with the rim free, all but all angles come back.
    std::vector<Eigen::RowVector3d> points;
    std::map<std::pair<int, int>, Index> number;
    const auto at = [&](int i, int j) {
        const Eigen::RowVector3d p(i + 0.5 * j, std::sqrt(0.75) * j, 0.0);
        const auto [place, is_new] = number.try_emplace({i, j}, static_cast<Index>(points.size()));
        if (is_new) points.push_back(p);
        return place->second;
    };
    std::vector<Eigen::RowVector3i> faces;
    const auto add = [&](std::array<std::pair<int, int>, 3> c) {
        double x = 0.0, y = 0.0;
        for (const auto& [i, j] : c) x += (i + 0.5 * j) / 3.0, y += std::sqrt(0.75) * j / 3.0;
        if (std::hypot(x, y) < 9.0)
            faces.emplace_back(at(c[0].first, c[0].second), at(c[1].first, c[1].second), at(c[2].first, c[2].second));
    };
    for (int i = -25; i < 25; ++i)
        for (int j = -25; j < 25; ++j) {
            add({{{i, j}, {i + 1, j}, {i, j + 1}}});
            add({{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}});
        }
    Mesh mesh{Vertices(points.size(), 3), Triangles(faces.size(), 3)};
    for (std::size_t v = 0; v < points.size(); ++v) mesh.vertices.row(v) = points[v];
    for (std::size_t f = 0; f < faces.size(); ++f) mesh.triangles.row(f) = faces[f];
    const Surface surface = require_bordered_genus_zero(mesh.triangles, static_cast<Index>(mesh.vertices.rows()));
    ExecutionContext context;
    const PlanarPoints disk = uniformize(mesh.vertices, mesh.triangles, {}, context).uv;
    const auto error = [&](const PlanarPoints& uv) {
        return measure_distortion(mesh.vertices, mesh.triangles, uv).angle_error_deg.mean;
    };
    RimFreedom freedom{std::vector<Index>(points.size()), std::vector<char>(points.size(), 0)};
    std::iota(freedom.same.begin(), freedom.same.end(), 0);
    PlanarPoints all_free = disk;
    free_rims(mesh.vertices, surface, freedom, all_free, context);
    EXPECT_LT(error(all_free), 0.15 * error(disk));

    std::set<Index> held;
    for (const Index v : surface.loops[0]) freedom.held[v] = 1, held.insert(v);
    PlanarPoints rim_held = disk;
    free_rims(mesh.vertices, surface, freedom, rim_held, context);
    EXPECT_LE(error(rim_held), error(disk));
    for (const Index v : held) EXPECT_EQ(rim_held.row(v), disk.row(v));

    // Two vertices of one number go the same way.
    std::ranges::fill(freedom.held, 0);
    const Index a = std::min(surface.loops[0][0], surface.loops[0][7]);
    const Index b = std::max(surface.loops[0][0], surface.loops[0][7]);
    freedom.same[b] = a;
    PlanarPoints alike = disk;
    free_rims(mesh.vertices, surface, freedom, alike, context);
    EXPECT_LT((alike.row(a) - disk.row(a) - alike.row(b) + disk.row(b)).norm(), 1e-12);
    EXPECT_GT((alike.row(a) - disk.row(a)).norm(), 1e-6);
}

TEST(Parts, what_is_even_stays_one_part)
{
    const Mesh mesh = flat_ring();
    const PartsResult result = parts(mesh);
    expect_sound(result, static_cast<Index>(mesh.triangles.rows()));
    ASSERT_EQ(result.parts.size(), 1U);
    EXPECT_EQ(result.parts[0].kind, PartKind::disk);
    EXPECT_EQ(result.cut_length, 0.0);
    EXPECT_LT(result.density_ratio_5_95, 1.05);
    EXPECT_LT(result.distortion.angle_error_deg.mean, 0.5);
}

TEST(Parts, a_higher_price_makes_fewer)
{
    // Three beads on a string, open below.
    std::vector<std::pair<double, double>> profile;
    for (int k = 0; k < 90; ++k) profile.emplace_back(0.35 + 0.65 * std::abs(std::sin(pi * k / 30.0)), 0.09 * k);
    profile.emplace_back(0.0, 0.09 * 90);
    const Mesh mesh = revolved(profile, 24);
    std::size_t last = 1000;
    double even = 2.0;
    for (const double price : {0.0005, 0.005, 0.05, 5.0}) {
        const PartsResult result = parts(mesh, {.price = price, .darts = 0.0});
        EXPECT_EQ(static_cast<Index>(result.distortion.flipped.size()), upside_down(result));
        EXPECT_EQ(result.distortion.flipped.size(), result.distortion.below_resolution.size());
        EXPECT_LE(result.parts.size(), last) << price;
        EXPECT_LE(result.even_area, even + 0.02) << price;
        last = result.parts.size();
        even = result.even_area;
    }
    EXPECT_EQ(last, 1U);
}

TEST(Parts, scale_and_place_change_nothing)
{
    Mesh mesh = finger(6.0);
    const PartsResult before = parts(mesh);
    for (const int exponent : {-500, -30, 30, 500}) {
        const double scale = std::ldexp(1.0, exponent);
        const Mesh scaled{scale * mesh.vertices, mesh.triangles};
        const PartsResult after = parts(scaled);
        EXPECT_EQ(after.part, before.part) << exponent;
        EXPECT_EQ(after.uv, before.uv) << exponent;
    }
    EXPECT_EQ(parts(mesh).uv, before.uv);
}

TEST(Parts, closed_surfaces_and_handles_are_opened)
{
    const Mesh ring = torus();
    const PartsResult result = parts(ring);
    expect_sound(result, static_cast<Index>(ring.triangles.rows()));
    EXPECT_EQ(result.handles_cut, 1);
    ExecutionContext context;
    EXPECT_THROW(parts_of(ring.vertices, ring.triangles, {.cut = false}, context), TopologyError);

    std::vector<std::pair<double, double>> profile{{0.0, -1.0}};
    for (int k = 1; k < 16; ++k) profile.emplace_back(std::sin(pi * k / 16), -std::cos(pi * k / 16));
    profile.emplace_back(0.0, 1.0);
    const Mesh sphere = revolved(profile, 32);
    const PartsResult opened = parts(sphere);
    expect_sound(opened, static_cast<Index>(sphere.triangles.rows()));
    EXPECT_GT(opened.even_area, 0.85);
}

TEST(Parts, a_torus_is_one_rectangle)
{
    // Its conformal factor is 1 / (4 + cos b): at most 5 to 3. Cut along the tube's circle, and from there to itself.
    const Mesh ring = torus(96, 32, 4.0);
    const PartsResult result = parts(ring, {.darts = 0.0});
    expect_sound(result, static_cast<Index>(ring.triangles.rows()));
    ASSERT_EQ(result.parts.size(), 1u);
    EXPECT_EQ(result.parts.front().kind, PartKind::tube);
    EXPECT_LT(result.density_ratio_5_95, 5.0 / 3.0);
    EXPECT_LT(result.distortion.angle_error_deg.mean, 1.0);
    const double area = face_areas(ring.vertices, ring.triangles).sum();
    EXPECT_LT(result.cut_length, 1.02 * 2.0 * pi * (1.0 + 3.0) / std::sqrt(area));
}

TEST(Parts, a_closed_surface_is_cut_along_closed_curves_alone)
{
    // Round at both ends, and six times as long as wide: two caps and a tube. No vertex ends a cut but those of the
    // slit.
    std::vector<std::pair<double, double>> profile;
    for (int i = 0; i <= 40; ++i)
        profile.emplace_back(i == 0 || i == 40 ? 0.0 : std::sin(pi * i / 40), -6.0 * std::cos(pi * i / 40));
    const Mesh mesh = revolved(profile, 48);
    const PartsResult result = parts(mesh, {});
    expect_sound(result, static_cast<Index>(mesh.triangles.rows()));
    std::map<std::pair<Index, Index>, std::set<Index>> sides;
    for (Index f = 0; f < static_cast<Index>(mesh.triangles.rows()); ++f)
        for (int k = 0; k < 3; ++k)
            sides[std::minmax(mesh.triangles(f, k), mesh.triangles(f, (k + 1) % 3))].insert(result.part[f]);
    std::map<Index, int> cuts;
    for (const auto& [edge, own] : sides)
        if (own.size() > 1) ++cuts[edge.first], ++cuts[edge.second];
    EXPECT_GT(cuts.size(), 40U);
    for (const auto& [vertex, count] : cuts) EXPECT_EQ(count, 2) << vertex;
    std::map<PartKind, int> kinds;
    for (const PartReport& part : result.parts) ++kinds[part.kind];
    EXPECT_EQ(kinds[PartKind::disk], 2);
    EXPECT_EQ(kinds[PartKind::tube], 1);
    double around = 0.0;  // of the borders alone: what is left of all cuts is the tube's slit
    for (const auto& [edge, own] : sides)
        if (own.size() > 1) around += (mesh.vertices.row(edge.first) - mesh.vertices.row(edge.second)).norm();
    around /= std::sqrt(face_areas(mesh.vertices, mesh.triangles).sum());
    EXPECT_NEAR(result.cut_length, around + result.slit_length, 1e-6);
}

TEST(Parts, slow_any_number_of_threads_gives_the_same)
{
    const Mesh one = finger(8.0);
    // Fingers of many sizes beside each other.
    Mesh many{Vertices(12 * one.vertices.rows(), 3), Triangles(12 * one.triangles.rows(), 3)};
    for (int i = 0; i < 12; ++i) {
        many.vertices.middleRows(i * one.vertices.rows(), one.vertices.rows()) =
            (1.0 + 0.3 * i) * (one.vertices.rowwise() + Eigen::RowVector3d(3.0 * i, 0.0, 0.0));
        many.triangles.middleRows(i * one.triangles.rows(), one.triangles.rows()) =
            one.triangles.array() + static_cast<Index>(i * one.vertices.rows());
    }
    for (const Mesh* mesh : {&one, static_cast<const Mesh*>(&many)}) {
        const PartsResult alone = parts(*mesh, {.price = 0.0005, .threads = 1});
        for (const int threads : {2, 5}) {
            const PartsResult together = parts(*mesh, {.price = 0.0005, .threads = threads});
            EXPECT_EQ(together.uv, alone.uv) << threads;
            EXPECT_EQ(together.part, alone.part) << threads;
            EXPECT_EQ(together.warnings, alone.warnings) << threads;
        }
    }
}

TEST(Parts, a_coarse_surface_keeps_loops_and_area)
{
    const Mesh mesh = finger(10.0, 48);
    const CutSurface whole = cut_surface(mesh.vertices, mesh.triangles, {});
    ExecutionContext context;
    const Index faces = static_cast<Index>(mesh.triangles.rows()) / 6;
    const CoarseSurface coarse = coarse_surface(mesh.vertices, mesh.triangles, faces, {}, context);
    EXPECT_LE(coarse.triangles.rows(), faces);
    EXPECT_GT(coarse.triangles.rows(), faces / 2);
    const CutSurface surface = cut_surface(coarse.vertices, coarse.triangles, {});
    EXPECT_EQ(surface.surface.loops.size(), 1U);
    EXPECT_NEAR(surface.areas.sum(), whole.areas.sum(), 0.03 * whole.areas.sum());
    for (std::size_t v = 0; v < coarse.vertex.size(); ++v)
        EXPECT_EQ(coarse.vertex_at[coarse.vertex[v]], static_cast<Index>(v));
}

TEST(Parts, polygons_stay_whole)
{
    const Mesh mesh = finger();
    PartsOptions options{.price = 0.0005};
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) options.polygon.push_back(static_cast<Index>(f / 2));
    const PartsResult result = parts(mesh, options);
    expect_sound(result, static_cast<Index>(mesh.triangles.rows()));
    EXPECT_GT(result.parts.size(), 1U);
    for (Eigen::Index f = 0; f + 1 < 2 * (mesh.triangles.rows() / 2); f += 2) {
        EXPECT_EQ(result.part[f], result.part[f + 1]);
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b)
                if (mesh.triangles(f, a) == mesh.triangles(f + 1, b)) {
                    EXPECT_EQ(result.uv.row(3 * f + a), result.uv.row(3 * f + 3 + b)) << f;
                }
    }
}

TEST(Parts, a_face_like_another_is_in_no_part)
{
    const Mesh mesh = flat_ring();
    Mesh doubled{mesh.vertices, Triangles(mesh.triangles.rows() + 1, 3)};
    doubled.triangles << mesh.triangles, mesh.triangles.row(5);
    const PartsResult result = parts(doubled);
    EXPECT_EQ(std::ranges::count(result.part, -1), 1);
    ASSERT_EQ(result.warnings.size(), 1U);
    EXPECT_EQ(result.warnings[0].kind, WarningKind::collapsed_faces);
}

TEST(Parts, wrong_prices_and_cancelled_calls)
{
    const Mesh mesh = finger();
    for (const double price : {0.0, -1.0, std::nan("")}) EXPECT_THROW(parts(mesh, {.price = price}), InputError);
    CancelToken token;
    token.cancel();
    ExecutionContext context({}, token);
    EXPECT_THROW(parts_of(mesh.vertices, mesh.triangles, {}, context), Cancelled);
}

TEST(Parts, progress_never_goes_back)
{
    const Mesh mesh = finger();
    double last = 0.0;
    ExecutionContext context(
        [&](double fraction, const std::string&) {
            EXPECT_GE(fraction, last);
            last = fraction;
        },
        {});
    parts_of(mesh.vertices, mesh.triangles, {}, context);
    EXPECT_GE(last, 0.9);
}

TEST(FlatPart, a_hole_that_is_turned_over_is_seen)
{
    const Mesh mesh = flat_ring();
    FlatPart part;
    part.surface = require_bordered_genus_zero(mesh.triangles, static_cast<Index>(mesh.vertices.rows()));
    PlanarPoints uv = 0.4 * mesh.vertices.leftCols<2>().array() + 0.5;
    EXPECT_TRUE(loops_apart(part, uv));
    PlanarPoints turned = uv;
    const VertexLoop& hole = part.surface.loops[1];
    for (const Index v : hole) turned(v, 1) = 1.0 - uv(v, 1);
    EXPECT_FALSE(loops_apart(part, turned));
    PlanarPoints crossing = uv;
    for (const Index v : hole) crossing(v, 0) += 0.35;
    EXPECT_FALSE(loops_apart(part, crossing));
}

TEST(Evenness, finds_the_best_window)
{
    std::mt19937 random(3);
    std::normal_distribution<double> spread(0.0, 1.0);
    VectorXd u(400), areas(400);
    for (Eigen::Index f = 0; f < u.size(); ++f) {
        u[f] = spread(random);
        areas[f] = std::abs(spread(random)) + 0.01;
    }
    double least = 1e300;
    for (double from = -4.0; from < 4.0; from += 1e-3) {
        double overflow = 0.0;
        for (Eigen::Index f = 0; f < u.size(); ++f)
            overflow += areas[f] * std::max({from - u[f], u[f] - from - tuning::even_range, 0.0});
        least = std::min(least, overflow);
    }
    const Evenness even = evenness(u, areas);
    EXPECT_NEAR(even.overflow, least, 1e-4 * least);
    EXPECT_NEAR(rough_overflow(u, areas), least, 2e-2 * least);
}

TEST(Parts, slow_a_large_closed_surface_is_cut_in_two_as_well)
{
    // An ellipsoid of more than 100,000 faces: no slit but those of tubes.
    std::vector<std::pair<double, double>> profile;
    for (int i = 0; i <= 240; ++i)
        profile.emplace_back(i == 0 || i == 240 ? 0.0 : std::sin(pi * i / 240), -3.0 * std::cos(pi * i / 240));
    const Mesh mesh = revolved(profile, 220);
    ASSERT_GT(mesh.triangles.rows(), 100000);
    const PartsResult result = parts(mesh, {.darts = 0.0});
    EXPECT_EQ(result.distortion.flipped.size(), 0U);
    EXPECT_GE(result.parts.size(), 2U);
    EXPECT_GT(result.even_area, 0.9);
    const double area = face_areas(mesh.vertices, mesh.triangles).sum();
    std::map<std::pair<Index, Index>, Index> first;
    double around = 0.0;
    for (Index f = 0; f < static_cast<Index>(mesh.triangles.rows()); ++f)
        for (int k = 0; k < 3; ++k) {
            const auto edge = std::minmax(mesh.triangles(f, k), mesh.triangles(f, (k + 1) % 3));
            const auto [at, is_new] = first.try_emplace({edge.first, edge.second}, result.part[f]);
            if (!is_new && at->second != result.part[f])
                around += (mesh.vertices.row(edge.first) - mesh.vertices.row(edge.second)).norm();
        }
    EXPECT_NEAR(result.cut_length, around / std::sqrt(area) + result.slit_length + result.dart_length, 1e-6);
}

/// The cut edges, by their ends' places. @param turned x is turned over
std::set<std::array<long, 6>> cut_places(const Mesh& mesh, const PartsResult& result, bool turned)
{
    std::map<std::pair<Index, Index>, std::set<std::array<double, 4>>> sides;
    for (Index f = 0; f < static_cast<Index>(mesh.triangles.rows()); ++f)
        for (int k = 0; k < 3; ++k) {
            Index a = 3 * f + k, b = 3 * f + (k + 1) % 3;
            if (mesh.triangles.data()[a] > mesh.triangles.data()[b]) std::swap(a, b);
            sides[{mesh.triangles.data()[a], mesh.triangles.data()[b]}].insert(
                {result.uv(a, 0), result.uv(a, 1), result.uv(b, 0), result.uv(b, 1)});
        }
    std::set<std::array<long, 6>> cuts;
    for (const auto& [edge, places] : sides) {
        if (places.size() < 2) continue;
        std::array<std::array<long, 3>, 2> ends{};
        for (int i = 0; i < 2; ++i) {
            const auto p = mesh.vertices.row(i == 0 ? edge.first : edge.second);
            ends[i] = {std::lround((turned ? -1e6 : 1e6) * p[0]), std::lround(1e6 * p[1]), std::lround(1e6 * p[2])};
        }
        if (ends[1] < ends[0]) std::swap(ends[0], ends[1]);
        cuts.insert({ends[0][0], ends[0][1], ends[0][2], ends[1][0], ends[1][1], ends[1][2]});
    }
    return cuts;
}

TEST(Parts, a_mirror_image_of_itself_is_cut_alike_on_both_sides)
{
    Mesh mesh = figure();
    PartsOptions options;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) options.polygon.push_back(static_cast<Index>(f / 2));
    for (const double price : {0.0003, 0.0037, 0.01}) {
        options.price = price;
        const PartsResult result = parts(mesh, options);
        expect_sound(result, static_cast<Index>(mesh.triangles.rows()));
        const auto cuts = cut_places(mesh, result, false);
        EXPECT_GT(cuts.size(), 20U) << price;
        EXPECT_EQ(cuts, cut_places(mesh, result, true)) << price;
    }
}

TEST(Parts, darts_make_texels_more_even_and_cuts_grow_by_them_at_least)
{
    const Mesh mesh = figure();
    const PartsResult without = parts(mesh, {.even = 0.1, .darts = 0.0});
    double cuts = without.cut_length;
    for (const double darts : {0.05, 0.5}) {
        const PartsResult result = parts(mesh, {.even = 0.1, .darts = darts});
        expect_sound(result, static_cast<Index>(mesh.triangles.rows()));
        EXPECT_GE(result.parts.size(), without.parts.size());
        EXPECT_GT(result.darts, 0);
        const double slits = result.slit_length - without.slit_length;  // these join loops
        const double cut = without.cut_length + slits + result.dart_length;
        if (result.parts.size() == without.parts.size())
            EXPECT_NEAR(result.cut_length, cut, 1e-3 * cut);  // borders are straight between the ends of darts
        else                                                  // parts were cut for room too
            EXPECT_GT(result.cut_length, cut);
        EXPECT_GT(result.cut_length, cuts);
        EXPECT_LT(result.density_ratio_5_95, without.density_ratio_5_95);
        EXPECT_LT(result.distortion.angle_error_deg.mean, without.distortion.angle_error_deg.mean);
        cuts = result.cut_length;
    }
    EXPECT_EQ(parts(mesh, {.even = 0.0, .darts = 1.0}).darts, 0);
}
