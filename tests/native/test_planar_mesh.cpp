#include "core/connectivity.h"
#include "core/errors.h"
#include "planar/planar_mesh.h"

#include "circle_domain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace koebe;

namespace {

using std::numbers::pi;
using test::points_on;

/// A star of n long spikes: far from convex.
VectorXcd spiked_star(int n)
{
    VectorXcd points(2 * n);
    for (int i = 0; i < 2 * n; ++i) points[i] = std::polar(i % 2 == 0 ? 1.0 : 0.25, pi * i / n);
    return points;
}

double signed_area(const VectorXcd& polygon)
{
    double area = 0.0;
    for (Eigen::Index i = 0; i < polygon.size(); ++i)
        area += 0.5 * std::imag(std::conj(polygon[i]) * polygon[(i + 1) % polygon.size()]);
    return area;
}

double triangle_area_of(const PlanarMesh& mesh, Eigen::Index f)
{
    const Complex a = mesh.points[mesh.triangles(f, 0)];
    return 0.5 * std::imag(std::conj(mesh.points[mesh.triangles(f, 1)] - a) * (mesh.points[mesh.triangles(f, 2)] - a));
}

double smallest_angle_deg(const PlanarMesh& mesh)
{
    double smallest = 180.0;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const Complex a = mesh.points[mesh.triangles(f, k)];
            smallest = std::min(smallest, 180.0 / pi *
                                              std::arg((mesh.points[mesh.triangles(f, (k + 2) % 3)] - a) /
                                                       (mesh.points[mesh.triangles(f, (k + 1) % 3)] - a)));
        }
    return smallest;
}

/// What must hold of every mesh: the polygons' points and edges as they are, the area filled without overlap.
void expect_fills(const PlanarMesh& mesh, const std::vector<VectorXcd>& polygons)
{
    double area = 0.0;
    Eigen::Index begin = 0, boundary_edges = 0;
    for (std::size_t k = 0; k < polygons.size(); ++k) {
        EXPECT_EQ(mesh.points.segment(begin, polygons[k].size()), polygons[k]);
        area += (k == 0 ? 1.0 : -1.0) * std::abs(signed_area(polygons[k]));
        begin += polygons[k].size();
        boundary_edges += polygons[k].size();
    }
    double filled = 0.0;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        EXPECT_GT(triangle_area_of(mesh, f), 0.0);
        filled += triangle_area_of(mesh, f);
    }
    EXPECT_NEAR(filled, area, 1e-12 * area);

    const std::vector<Index> twin = pair_halfedges(mesh.triangles, static_cast<Index>(mesh.points.size()));
    EXPECT_EQ(std::count(twin.begin(), twin.end(), no_twin), boundary_edges);
    for (Index h = 0; h < static_cast<Index>(twin.size()); ++h)
        EXPECT_EQ(twin[h] == no_twin, origin(mesh.triangles, h) < begin && target(mesh.triangles, h) < begin);
    // Euler: 2 - 2 g - loops with g = 0.
    const Eigen::Index edges = (3 * mesh.triangles.rows() + boundary_edges) / 2;
    EXPECT_EQ(mesh.points.size() - edges + mesh.triangles.rows(), 2 - static_cast<Eigen::Index>(polygons.size()));
}

}  // namespace

TEST(PlanarMesh, fills_polygons_without_touching_their_edges)
{
    for (const int n : {3, 4, 5, 8, 30, 200}) {
        const VectorXcd polygon = points_on({{2.0, -1.0}, 3.0}, n);
        expect_fills(planar_mesh({polygon}), {polygon});
    }
    for (const double skew : {0.5, 0.9, 0.99}) {
        const VectorXcd polygon = points_on({{0.0, 0.0}, 1.0}, 100, skew);
        expect_fills(planar_mesh({polygon}), {polygon});
    }
    expect_fills(planar_mesh({spiked_star(9)}), {spiked_star(9)});
}

TEST(PlanarMesh, leaves_holes_open)
{
    const std::vector<VectorXcd> polygons{points_on({{0.0, 0.0}, 1.0}, 120), points_on({{0.4, 0.3}, 0.2}, 25),
                                          points_on({{-0.4, 0.2}, 0.3}, 37).reverse()};
    expect_fills(planar_mesh(polygons, {.longest = 0.05}), polygons);
}

TEST(PlanarMesh, clockwise_polygons_give_counter_clockwise_triangles)
{
    const VectorXcd polygon = points_on({{0.0, 0.0}, 1.0}, 40).reverse();
    expect_fills(planar_mesh({polygon}), {polygon});
}

TEST(PlanarMesh, edges_have_the_wanted_length_and_triangles_are_good)
{
    const double h = 2.0 * pi / 200;
    const PlanarMesh mesh = planar_mesh({points_on({{0.0, 0.0}, 1.0}, 200)}, {.longest = h});
    double sum = 0.0, longest = 0.0;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const double length =
                std::abs(mesh.points[mesh.triangles(f, (k + 1) % 3)] - mesh.points[mesh.triangles(f, k)]);
            sum += length;
            longest = std::max(longest, length);
        }
    EXPECT_NEAR(sum / (3.0 * mesh.triangles.rows()), h, 0.05 * h);
    EXPECT_LT(longest, 1.7 * h);
    EXPECT_GT(smallest_angle_deg(mesh), 22.0);
}

TEST(PlanarMesh, gradation_coarsens_away_from_the_boundary)
{
    const VectorXcd polygon = points_on({{0.0, 0.0}, 1.0}, 300);
    const auto faces = [&](double gradation) {
        return planar_mesh({polygon}, {.gradation = gradation}).triangles.rows();
    };
    EXPECT_GT(faces(0.1), 2 * faces(0.3));
    EXPECT_GT(smallest_angle_deg(planar_mesh({polygon}, {.gradation = 0.3})), 18.0);
}

TEST(PlanarMesh, does_not_depend_on_the_unit_and_reruns_are_identical)
{
    const VectorXcd polygon = points_on({{0.0, 0.0}, 1.0}, 60, 0.4);
    const PlanarMesh mesh = planar_mesh({polygon}), again = planar_mesh({polygon});
    EXPECT_EQ(mesh.points, again.points);
    EXPECT_EQ(mesh.triangles, again.triangles);
    for (const double scale : {std::ldexp(1.0, -30), std::ldexp(1.0, 30)}) {
        const PlanarMesh scaled = planar_mesh({scale * polygon});
        EXPECT_EQ(scaled.triangles, mesh.triangles);
        EXPECT_EQ(scaled.points, scale * mesh.points);
    }
}

TEST(PlanarMesh, polygons_that_are_not_simple_are_refused_with_the_place)
{
    VectorXcd bow(4);
    bow << Complex(0, 0), Complex(1, 1), Complex(1, 0), Complex(0, 1);
    EXPECT_THROW(planar_mesh({bow}), InputError);

    VectorXcd doubled = points_on({{0.0, 0.0}, 1.0}, 6);
    doubled[3] = doubled[1];
    try {
        planar_mesh({doubled});
        FAIL();
    } catch (const InputError& error) {
        EXPECT_FALSE(error.elements().empty());
    }
    EXPECT_THROW(planar_mesh({points_on({{0.0, 0.0}, 1.0}, 2)}), InputError);
    VectorXcd broken = points_on({{0.0, 0.0}, 1.0}, 6);
    broken[2] = Complex(std::nan(""), 0.0);
    EXPECT_THROW(planar_mesh({broken}), InputError);
}

TEST(PlanarMesh, takes_polygons_of_any_size)
{
    const VectorXcd polygon = points_on({{0.1, -0.2}, 0.7}, 30, 0.5);
    const PlanarMesh mesh = planar_mesh({polygon});
    for (const int exponent : {-900, -300, 300, 1000}) {
        const double scale = std::ldexp(1.0, exponent);
        const PlanarMesh scaled = planar_mesh({scale * polygon});
        EXPECT_EQ(scaled.triangles, mesh.triangles) << exponent;
        EXPECT_EQ(scaled.points, scale * mesh.points) << exponent;
    }
}

TEST(PlanarMesh, bare_it_has_the_polygons_points_only)
{
    const std::vector<VectorXcd> polygons = {spiked_star(9), points_on({{0.0, 0.0}, 0.1}, 12)};
    const PlanarMesh mesh = planar_mesh(polygons, {.bare = true});
    EXPECT_EQ(mesh.points.size(), 18 + 12);
    ASSERT_EQ(mesh.triangles.rows(), 18 + 12);  // Euler: points + 2 (holes - 1)
    double area = 0.0;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        EXPECT_GT(triangle_area_of(mesh, f), 0.0);
        area += triangle_area_of(mesh, f);
    }
    EXPECT_NEAR(area, std::abs(signed_area(polygons[0])) - std::abs(signed_area(polygons[1])), 1e-12);
    EXPECT_GT(planar_mesh(polygons).points.size(), mesh.points.size());
}
