// The laws of the normalization: what goes to 0 and to 1 is there exactly, and the map is an automorphism of the other.
#include "circle_domain.h"
#include "core/errors.h"
#include "ear_domain.h"
#include "embedding/embedded_map.h"
#include "loop_circles.h"
#include "pipeline/final_check.h"
#include "pipeline/normalization.h"
#include "pipeline/uniformize.h"
#include "random_disks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

using namespace koebe;
using namespace koebe::test;

namespace {

Complex at(const PlanarPoints& uv, Index v) { return {uv(v, 0), uv(v, 1)}; }

std::vector<char> on_loops(const CircleDomain& domain)
{
    std::vector<char> result(domain.points.size(), 0);
    for (const VertexLoop& loop : domain.loops)
        for (const Index v : loop) result[v] = 1;
    return result;
}

/// The inner vertex nearest to a place.
Index inside_near(const CircleDomain& domain, Complex place)
{
    const std::vector<char> rim = on_loops(domain);
    Index best = -1;
    for (Index v = 0; v < static_cast<Index>(domain.points.size()); ++v)
        if (!rim[v] && (best < 0 || std::abs(domain.points[v] - place) < std::abs(domain.points[best] - place)))
            best = v;
    return best;
}

UniformizeOptions outer_options(const CircleDomain& domain)
{
    UniformizeOptions options;
    options.outer = OuterLoop::vertex;
    options.outer_vertex = domain.loops[0].front();
    return options;
}

UniformizeOptions placed(const CircleDomain& domain, Complex center)
{
    UniformizeOptions options = outer_options(domain);
    options.center = inside_near(domain, center);
    options.point = domain.loops[0][domain.loops[0].size() / 3];
    return options;
}

/// The automorphism of the disk that a result is to be of another, by where the centre and the point lie in that.
Moebius automorphism(const PlanarPoints& plain, const UniformizeOptions& options)
{
    Moebius result{at(plain, options.center)};
    const Complex image = result(at(plain, options.point));
    result.turn = std::conj(image) / std::abs(image);
    return result;
}

void expect_in_place(const UniformizeResult& result, const UniformizeOptions& options)
{
    EXPECT_TRUE(result.converged);
    EXPECT_TRUE(result.distortion.flipped.empty());
    EXPECT_EQ(result.center, options.center);
    EXPECT_EQ(result.point, options.point);
    if (options.center >= 0) {
        EXPECT_EQ(at(result.uv, options.center), Complex(0.0, 0.0));
    }
    if (options.point >= 0) {
        EXPECT_EQ(at(result.uv, options.point), Complex(1.0, 0.0));
    }
    EXPECT_LE(result.uv.rowwise().norm().maxCoeff(), 1.0 + 1e-12);
    for (const LoopReport& loop : result.loops) {
        EXPECT_TRUE(loop.off_circle.empty());
        for (const Index v : loop.vertices)
            EXPECT_NEAR(std::abs(at(result.uv, v) - loop.circle.center), loop.circle.radius, 1e-12);
    }
}

std::vector<Circle> some_circles(std::size_t count)
{
    std::vector<Circle> circles = five_circles();
    circles.resize(count);
    return circles;
}

}  // namespace

TEST(Normalization, holds_exactly_for_every_engine_method_and_number_of_loops)
{
    for (const std::size_t loops : {1u, 2u, 3u, 5u}) {
        const CircleDomain domain = make_circle_domain(some_circles(loops), 1500);
        const Vertices surface = lift(domain.points, Lift::enneper);
        for (const Engine engine : {Engine::condensed, Engine::mesh})
            for (const bool polish : {false, true}) {
                UniformizeOptions options = placed(domain, {-0.4, -0.55});
                options.engine = engine;
                options.polish = polish;
                options.method = loops == 3 ? Method::ck : Method::gk;
                expect_in_place(uniformize(surface, domain.triangles, options), options);
            }
    }
}

TEST(Normalization, is_an_automorphism_of_the_plain_map_to_second_order)
{
    for (const std::size_t loops : {1u, 5u}) {
        double first = 0.0, last = 0.0;
        for (const Index faces : {1000, 16000}) {
            const CircleDomain domain = make_circle_domain(some_circles(loops), faces);
            const Vertices surface = lift(domain.points, Lift::polynomial);
            const UniformizeOptions options = placed(domain, {-0.4, -0.55});
            const PlanarPoints plain = uniformize(surface, domain.triangles, outer_options(domain)).uv;
            const UniformizeResult result = uniformize(surface, domain.triangles, options);
            const Moebius expected = automorphism(plain, options);
            double sum = 0.0;
            for (Index v = 0; v < static_cast<Index>(plain.rows()); ++v)
                sum += std::norm(expected(at(plain, v)) - at(result.uv, v));
            last = std::sqrt(sum / static_cast<double>(plain.rows()));
            if (first == 0.0) first = last;
        }
        EXPECT_LT(last, 2e-4);
        EXPECT_GT(std::log(first / last) / std::log(4.0), 1.5) << first << " -> " << last;
    }
}

TEST(Normalization, changes_no_inversive_distance)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 2000);
    const Vertices surface = lift(domain.points, Lift::sphere);
    const UniformizeResult plain = uniformize(surface, domain.triangles, outer_options(domain));
    const UniformizeResult moved = uniformize(surface, domain.triangles, placed(domain, {0.2, -0.8}));
    EXPECT_GT(std::abs(moved.loops[1].circle.center - plain.loops[1].circle.center), 0.1);
    EXPECT_LT(inversive_distance_error(circles_of(moved.loops), circles_of(plain.loops)), 1e-11);
}

TEST(Normalization, the_center_alone_turns_nothing_and_the_point_alone_only_turns)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 4000);
    const Vertices surface = lift(domain.points, Lift::polynomial);
    const PlanarPoints plain = uniformize(surface, domain.triangles, outer_options(domain)).uv;
    const UniformizeOptions both = placed(domain, {-0.4, -0.55});

    UniformizeOptions options = both;
    options.point = -1;
    const UniformizeResult centered = uniformize(surface, domain.triangles, options);
    expect_in_place(centered, options);
    const Moebius without_turn{at(plain, options.center)};
    for (const Index v : domain.loops[0])
        EXPECT_LT(std::abs(without_turn(at(plain, v)) - at(centered.uv, v)), 5e-3) << v;

    options = both;
    options.center = -1;
    for (const Balance balance : {Balance::none, Balance::area}) {
        options.balance = balance;
        UniformizeOptions without = outer_options(domain);
        without.balance = balance;
        const PlanarPoints unturned = uniformize(surface, domain.triangles, without).uv;
        const UniformizeResult turned = uniformize(surface, domain.triangles, options);
        expect_in_place(turned, options);
        const Complex turn = std::conj(at(unturned, options.point));
        for (Index v = 0; v < static_cast<Index>(plain.rows()); ++v)
            EXPECT_LT(std::abs(turn * at(unturned, v) - at(turned.uv, v)), 1e-14) << v;
    }
}

TEST(Normalization, normalize_is_exact_and_changes_nothing_the_second_time)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 1000);
    MapInput whole;
    whole.loops = domain.loops;
    whole.center = inside_near(domain, {-0.4, -0.55});
    whole.point = domain.loops[0][7];
    CircleMap map;
    map.uv.resize(domain.points.size(), 2);
    map.uv << domain.points.real(), domain.points.imag();
    map.circles = domain.circles;
    map.circles.push_back({Complex(0.3, 0.1), 1e-17});  // smaller than the rounding of its centre
    normalize(whole, map);
    EXPECT_EQ(at(map.uv, whole.center), Complex(0.0, 0.0));
    EXPECT_EQ(at(map.uv, whole.point), Complex(1.0, 0.0));
    for (std::size_t k = 0; k < domain.loops.size(); ++k)
        for (const Index v : domain.loops[k])
            EXPECT_NEAR(std::abs(at(map.uv, v) - map.circles[k].center), map.circles[k].radius, 1e-14);
    const double a = std::abs(domain.points[whole.center]);
    EXPECT_GT(map.circles.back().radius, 1e-17 * (1.0 - a) / (1.0 + a));
    const CircleMap once = map;
    normalize(whole, map);
    EXPECT_TRUE(map.uv == once.uv);
    EXPECT_EQ(map.circles[2].center, once.circles[2].center);
}

TEST(Normalization, the_same_surface_renumbered_gets_the_same_map)
{
    const CircleDomain domain = make_circle_domain(some_circles(3), 1000);
    const Vertices surface = lift(domain.points, Lift::enneper);
    const UniformizeOptions options = placed(domain, {-0.4, -0.55});
    const PlanarPoints expected = uniformize(surface, domain.triangles, options).uv;

    std::vector<Index> number(surface.rows());
    std::iota(number.begin(), number.end(), 0);
    std::mt19937 random(1);
    std::shuffle(number.begin(), number.end(), random);
    Vertices renumbered(surface.rows(), 3);
    renumbered(number, Eigen::all) = surface;
    Triangles triangles = domain.triangles.unaryExpr([&](Index v) { return number[v]; });
    UniformizeOptions same = options;
    same.outer_vertex = number[options.outer_vertex];
    same.center = number[options.center];
    same.point = number[options.point];
    const PlanarPoints found = uniformize(renumbered, triangles, same).uv;
    EXPECT_TRUE(PlanarPoints(found(number, Eigen::all)) == expected);
}

TEST(Normalization, the_point_names_the_outer_loop)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 1000);
    const Vertices surface = lift(domain.points, Lift::plane);
    UniformizeOptions options;
    options.point = domain.loops[2][1];
    for (const Balance balance : {Balance::none, Balance::area}) {
        options.balance = balance;
        const UniformizeResult result = uniformize(surface, domain.triangles, options);
        EXPECT_EQ(result.loops[0].vertices.size(), domain.loops[2].size());
        EXPECT_EQ(at(result.uv, options.point), Complex(1.0, 0.0));
    }
    options.outer = OuterLoop::longest;
    EXPECT_THROW(uniformize(surface, domain.triangles, options), InputError);
    options.outer = OuterLoop::vertex;
    options.outer_vertex = domain.loops[1][0];
    EXPECT_THROW(uniformize(surface, domain.triangles, options), InputError);
    options.outer_vertex = domain.loops[2][0];
    EXPECT_EQ(at(uniformize(surface, domain.triangles, options).uv, options.point), Complex(1.0, 0.0));
}

TEST(Normalization, a_vertex_that_cannot_go_there_is_named)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 1000);
    const Index count = static_cast<Index>(domain.points.size());
    Vertices surface(count + 1, 3);  // the last is of no face
    surface << lift(domain.points, Lift::plane), Vertices::Zero(1, 3);
    const auto expect_named = [&](const UniformizeOptions& options, Index vertex) {
        try {
            uniformize(surface, domain.triangles, options);
            ADD_FAILURE() << vertex;
        } catch (const InputError& error) {
            EXPECT_EQ(error.elements(), std::vector<Index>{vertex});
            EXPECT_NE(std::string(error.what()).find(std::to_string(vertex)), std::string::npos);
        }
    };
    const Index inside = inside_near(domain, {-0.4, -0.55});
    for (const Index vertex : {domain.loops[0][3], domain.loops[2][0], count, count + 1, 2000000000}) {
        UniformizeOptions options;
        options.center = vertex;
        expect_named(options, vertex);
    }
    for (const Index vertex : {inside, count, count + 1, 2000000000}) {
        UniformizeOptions options;
        options.point = vertex;
        expect_named(options, vertex);
    }
    UniformizeOptions options;
    options.center = inside;
    options.balance = Balance::area;
    EXPECT_THROW(uniformize(surface, domain.triangles, options), InputError);
}

TEST(Normalization, holds_within_ears)
{
    for (const int loop : {0, 1}) {
        CircleDomain domain = make_circle_domain(some_circles(2), 600);
        const VertexLoop rim = domain.loops[loop];
        const Index ear = glue_ear(domain, loop, rim[4], rim[5], 1.0);
        // A vertex in the middle of the ear.
        const Eigen::RowVector3<Index> face = domain.triangles.row(domain.triangles.rows() - 1);
        const Index middle = static_cast<Index>(domain.points.size());
        domain.points.conservativeResize(middle + 1);
        domain.points[middle] = (domain.points[face[0]] + domain.points[face[1]] + domain.points[face[2]]) / 3.0;
        const Eigen::Index rows = domain.triangles.rows();
        domain.triangles.conservativeResize(rows + 2, 3);
        domain.triangles.row(rows - 1) << face[0], face[1], middle;
        domain.triangles.row(rows) << face[1], face[2], middle;
        domain.triangles.row(rows + 1) << face[2], face[0], middle;

        UniformizeOptions options = outer_options(domain);
        options.center = middle;
        options.point = loop == 0 ? ear : domain.loops[0][2];
        const UniformizeResult result = uniformize(lift(domain.points, Lift::plane), domain.triangles, options);
        EXPECT_TRUE(result.converged);
        EXPECT_TRUE(result.distortion.flipped.empty());
        EXPECT_EQ(at(result.uv, options.center), Complex(0.0, 0.0));
        EXPECT_EQ(at(result.uv, options.point), Complex(1.0, 0.0));
    }
}

TEST(Normalization, the_embedded_map_has_a_vertex_of_any_depth_at_0)
{
    std::mt19937 random(3);
    for (int i = 0; i < 8; ++i) {
        const Triangles triangles = as_triangles(i % 2 == 0 ? stacked_disk(60, 0, random) : limb(12, 6));
        const Surface surface = require_bordered_genus_zero(triangles, triangles.maxCoeff() + 1);
        const VertexLoop& outer = surface.loops[0];
        VectorXcd rim(outer.size());
        for (std::size_t k = 0; k < outer.size(); ++k)
            rim[k] = std::polar(1.0, 2.0 * std::numbers::pi * static_cast<double>(k) / outer.size());
        const FixedPlaces places{surface.vertex_count - 1, outer[1]};
        ASSERT_EQ(std::ranges::count(outer, places.center), 0);
        const CircleMap map =
            embedded_map(Vertices::Random(surface.vertex_count, 3), surface, surface.loops, {}, {}, rim, {}, places);
        EXPECT_EQ(at(map.uv, places.center), Complex(0.0, 0.0)) << i;
        EXPECT_LT(std::abs(at(map.uv, places.point) - 1.0), 1e-14) << i;
        EXPECT_FALSE(find_faults(surface.triangles, surface.loops, map.uv, map.circles).any()) << i;
    }
}
