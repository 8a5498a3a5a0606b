#include "circle_domain.h"
#include "circle_samples.h"
#include "circles/circle_fit.h"
#include "core/errors.h"
#include "pipeline/uniformize.h"
#include "shape/conformal_module.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

using namespace koebe;
using namespace koebe::test;

namespace {

/// The module of a mesh with the loops numbered as in the domain.
VectorXd measured_module(const CircleDomain& domain, const Vertices& vertices)
{
    UniformizeOptions options;
    options.outer = OuterLoop::vertex;
    options.outer_vertex = domain.loops[0].front();
    ExecutionContext context;
    const UniformizeResult result = uniformize(vertices, domain.triangles, options, context);
    EXPECT_TRUE(result.converged);
    std::vector<Circle> circles;
    for (const VertexLoop& loop : domain.loops)
        for (const LoopReport& report : result.loops)
            if (std::ranges::find(report.vertices, loop.front()) != report.vertices.end())
                circles.push_back(report.circle);
    return conformal_module(circles);
}

}  // namespace

TEST(ConformalModule, has_the_numbers_of_teichmueller_space_and_their_names)
{
    for (int holes = 0; holes <= 9; ++holes) {
        const Eigen::Index numbers = holes == 0 ? 0 : holes == 1 ? 1 : 3 * holes - 3;
        EXPECT_EQ(conformal_module(random_domain(holes, 1)).size(), numbers);
        EXPECT_EQ(module_names(holes + 1).size(), static_cast<std::size_t>(numbers));
    }
    EXPECT_EQ(module_names(4), (std::vector<std::string>{"r_1", "y_2", "r_2", "x_3", "y_3", "r_3"}));
}

TEST(ConformalModule, reads_off_a_domain_in_normal_position)
{
    const std::vector<Circle> circles{{}, {{0.0, 0.0}, 0.25}, {{0.0, 0.6}, 0.125}, {{0.4, -0.3}, 0.2}};
    const VectorXd module = conformal_module(circles);
    const double expected[] = {0.25, 0.6, 0.125, 0.4, -0.3, 0.2};
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(module[i], expected[i], 1e-15) << i;
}

TEST(ConformalModule, is_the_same_for_every_moebius_image)
{
    for (const int holes : {1, 2, 4, 8}) {
        const std::vector<Circle> circles = random_domain(holes, 3);
        for (const Moebius& map : some_maps)
            EXPECT_LT((conformal_module(image(map, circles)) - conformal_module(circles)).norm(), 1e-12) << holes;
    }
}

TEST(ConformalModule, follows_the_loops_when_they_are_renumbered)
{
    const std::vector<Circle> circles = five_circles();
    const std::vector<int> order{0, 3, 1, 4, 2};
    EXPECT_EQ(conformal_module(reordered(circles, order)), conformal_module(circles, order));
}

TEST(ConformalModule, with_another_outer_loop_keeps_the_inversive_distances)
{
    const std::vector<Circle> circles = five_circles();
    for (const std::vector<int>& order : {std::vector<int>{2, 0, 1, 3, 4}, {4, 3, 2, 1, 0}}) {
        const std::vector<Circle> placed = normalized_circles(circles, order);
        EXPECT_LT(inversive_distance_error(placed, reordered(circles, order)), 1e-12);
        EXPECT_NO_THROW(require_circle_domain(placed));
        EXPECT_LT(std::abs(placed[1].center), 1e-14);
        EXPECT_LT(std::abs(placed[2].center.real()), 1e-14);
        EXPECT_GT(placed[2].center.imag(), 0.0);
    }
}

TEST(ConformalModule, with_another_outer_loop_is_that_of_the_inverted_points)
{
    // w = r / (z - c) turns the hole 2 inside out and is holomorphic, so the orientation stays.
    const std::vector<Circle> circles = five_circles();
    std::vector<Circle> inverted{Circle{}};
    for (const int k : {0, 1, 3, 4}) {
        VectorXcd points(16);
        for (int i = 0; i < 16; ++i) {
            const Complex z = circles[k].center + std::polar(circles[k].radius, 0.39 * i);
            points[i] = circles[2].radius / (z - circles[2].center);
        }
        inverted.push_back(fit_circle_least_squares(points));
    }
    EXPECT_LT((conformal_module(inverted) - conformal_module(circles, {2, 0, 1, 3, 4})).norm(), 1e-10);
}

TEST(ConformalModule, tells_a_shape_from_its_mirror_image_from_three_holes_on)
{
    const auto apart = [](const std::vector<Circle>& circles) {
        return (conformal_module(mirrored(circles)) - conformal_module(circles)).norm();
    };
    EXPECT_LT(apart(random_domain(2, 5)), 1e-14);
    EXPECT_GT(apart(five_circles()), 0.1);
}

TEST(ConformalModule, in_canonical_order_does_not_know_how_loops_are_numbered)
{
    for (const std::vector<Circle>& circles :
         {random_domain(1, 2), random_domain(3, 2), five_circles(), random_domain(12, 2)}) {
        const VectorXd module = conformal_module(circles, canonical_order(circles));
        std::vector<int> shuffled(circles.size());
        std::iota(shuffled.begin(), shuffled.end(), 0);
        for (int turn = 0; turn < 5; ++turn) {
            std::rotate(shuffled.begin() + 1, shuffled.begin() + shuffled.size() / 2, shuffled.end());
            const auto other = image(some_maps[2], reordered(circles, shuffled));
            EXPECT_LT((conformal_module(other, canonical_order(other)) - module).norm(), 1e-12);
        }
    }
}

TEST(ConformalModule, in_canonical_order_noise_does_not_swap_loops_that_are_alike)
{
    // Two eyes and a mouth, the eyes equal up to what a mesh leaves of the symmetry.
    const auto module = [](double noise) {
        const std::vector<Circle> face{{}, {{-0.4, 0.3}, 0.2 + noise}, {{0.4, 0.3}, 0.2 - noise}, {{0.1, -0.4}, 0.15}};
        return conformal_module(face, canonical_order(face));
    };
    EXPECT_LT((module(1e-4) - module(-1e-4)).norm(), 2e-3);
}

TEST(ConformalModule, in_canonical_order_does_not_know_which_loop_is_outside)
{
    const std::vector<Circle> circles = random_domain(5, 4);
    const VectorXd module = conformal_module(circles, canonical_order(circles, true));
    for (const std::vector<int>& order : {std::vector<int>{3, 0, 1, 2, 4, 5}, {5, 4, 3, 2, 1, 0}}) {
        const std::vector<Circle> other = normalized_circles(circles, order);
        EXPECT_LT((conformal_module(other, canonical_order(other, true)) - module).norm(), 1e-12);
    }
}

TEST(ConformalModule, separation_is_the_logarithm_of_the_radii_of_concentric_circles)
{
    for (const double radius : {0.9, 0.3, 1e-3})
        for (const Moebius& map : some_maps)
            EXPECT_NEAR(conformal_separation({}, map(Circle{{0.0, 0.0}, radius})), -std::log(radius), 1e-9);
}

TEST(ConformalModule, refuses_what_is_no_circle_domain)
{
    EXPECT_THROW(conformal_module({{}, {{0.5, 0.0}, 0.3}, {{0.2, 0.0}, 0.1}}), InputError);
    EXPECT_THROW(conformal_module({{}, {{0.8, 0.0}, 0.3}}), InputError);
    EXPECT_THROW(conformal_module({{{0.0, 0.0}, 2.0}}), InputError);
    EXPECT_THROW(conformal_module({{}, {{0.0, 0.0}, 9e-279}, {{3e-277, 0.0}, 9e-279}}), InputError);
    EXPECT_TRUE(conformal_module({{}, {{0.0, 0.0}, 1e-99}, {{3e-99, 0.0}, 1e-99}}).allFinite());
    EXPECT_THROW(conformal_module(five_circles(), {0, 1, 2, 3}), InputError);
    EXPECT_THROW(conformal_module(five_circles(), {0, 1, 2, 3, 3}), InputError);
}

TEST(ConformalModule, of_a_mesh_is_that_of_its_exact_domain_under_every_conformal_lift)
{
    // Also what remeshing changes: two meshes of one domain differ by twice this at most.
    const VectorXd exact = conformal_module(five_circles());
    for (const Index faces : {8000, 20000}) {
        const CircleDomain domain = make_circle_domain(five_circles(), faces);
        for (const Lift kind : curved_lifts) {
            const double error = (measured_module(domain, lift(domain.points, kind)) - exact).cwiseAbs().maxCoeff();
            RecordProperty(to_string(kind) + std::to_string(faces), std::to_string(error));
            EXPECT_LT(error, 5e-4) << to_string(kind) << ' ' << faces;
        }
    }
}
