
#include "core/connectivity.h"
#include "core/errors.h"
#include "loop_circles.h"
#include "mapped_domain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

using namespace koebe;
using namespace koebe::test;

namespace {

MappedSurface flat_domain(Index faces) { return mapped(make_circle_domain(five_circles(), faces)); }

double face_area(const PlanarPoints& uv, const Triangles& triangles, Eigen::Index f)
{
    const Eigen::RowVector2d a = uv.row(triangles(f, 1)) - uv.row(triangles(f, 0));
    const Eigen::RowVector2d b = uv.row(triangles(f, 2)) - uv.row(triangles(f, 0));
    return 0.5 * (a[0] * b[1] - a[1] * b[0]);
}

std::ptrdiff_t rim_edges(const Triangles& triangles, Eigen::Index vertex_count)
{
    return std::ranges::count(pair_halfedges(triangles, static_cast<Index>(vertex_count)), no_twin);
}

}  // namespace

TEST(CutMesh, pieces_fill_their_faces_and_points_are_vertices)
{
    const MappedSurface surface = flat_domain(400);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    std::vector<SurfacePoint> points;
    for (int i = 0; i < 60; ++i) {
        Eigen::RowVector3d weights(share(random), share(random), share(random));
        if (i % 3 == 1) weights[i % 2] = 0.0;                                    // on an edge
        if (i % 3 == 2) weights = {0.0, 0.0, 1.0};                               // at a vertex
        points.push_back({static_cast<Index>(i % 7), weights / weights.sum()});  // many in one face
    }
    const CutMesh mesh = cut_at_points(surface.triangles, static_cast<Index>(surface.uv.rows()), points);
    const PlanarPoints uv = mesh.extended(surface.uv, surface.triangles);
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_LT((uv.row(mesh.vertex[i]) - points[i].of(surface.uv, surface.triangles)).norm(), 1e-8);
    VectorXd area = VectorXd::Zero(surface.triangles.rows());
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        EXPECT_GT(face_area(uv, mesh.triangles, f), 0.0);
        area[mesh.face[f]] += face_area(uv, mesh.triangles, f);
        const SurfacePoint middle = mesh.on_mesh(static_cast<Index>(f), Eigen::RowVector3d::Constant(1.0 / 3.0),
                                                 surface.triangles, static_cast<Index>(surface.uv.rows()));
        const Eigen::RowVector2d expected =
            (uv.row(mesh.triangles(f, 0)) + uv.row(mesh.triangles(f, 1)) + uv.row(mesh.triangles(f, 2))) / 3.0;
        EXPECT_LT((middle.of(surface.uv, surface.triangles) - expected).norm(), 1e-12);
    }
    for (Eigen::Index f = 0; f < area.size(); ++f)
        EXPECT_NEAR(area[f], face_area(surface.uv, surface.triangles, f), 1e-12);
    // Euler: two triangles for each point, and one for each on a rim.
    EXPECT_EQ(mesh.triangles.rows() + rim_edges(mesh.triangles, uv.rows()),
              surface.triangles.rows() + rim_edges(surface.triangles, surface.uv.rows()) +
                  2 * static_cast<Eigen::Index>(mesh.added.size()));
}

TEST(LandmarkMap, landmarks_lie_exactly_and_rims_stay_on_their_circles)
{
    const MappedSurface surface = flat_domain(2000);
    const Index count = static_cast<Index>(surface.uv.rows());
    std::vector<SurfacePoint> points;
    VectorXcd places(6);
    for (Index i = 0; i < 6; ++i) {
        points.push_back({i * static_cast<Index>(surface.triangles.rows()) / 6, {0.3, 0.3, 0.4}});
        const Eigen::RowVector2d here = points.back().of(surface.uv, surface.triangles);
        places[i] = Complex(here[0], here[1]) + 0.02 * std::polar(1.0, 1.7 * i);
    }
    ExecutionContext context;
    const LandmarkMap map =
        map_with_landmarks(surface, circles_of(surface.loops), surface.uv, surface.uv, points, places, false, context);
    for (Index i = 0; i < 6; ++i) {
        EXPECT_GE(map.mesh.vertex[i], count);
        EXPECT_EQ(Complex(map.uv(map.mesh.vertex[i], 0), map.uv(map.mesh.vertex[i], 1)), places[i]);
    }
    EXPECT_TRUE(folded_faces(map.mesh.triangles, map.uv).empty());
    for (const LoopReport& loop : surface.loops)
        for (const Index v : loop.vertices)
            EXPECT_NEAR(std::abs(Complex(map.uv(v, 0), map.uv(v, 1)) - loop.circle.center), loop.circle.radius, 1e-12);
}

TEST(LandmarkMap, a_landmark_that_stays_moves_nothing)
{
    const MappedSurface surface = flat_domain(2000);
    const std::vector<SurfacePoint> points{{700, {0.2, 0.5, 0.3}}};
    const Eigen::RowVector2d here = points[0].of(surface.uv, surface.triangles);
    const VectorXcd places = VectorXcd::Constant(1, Complex(here[0], here[1]));
    ExecutionContext context;
    const LandmarkMap map =
        map_with_landmarks(surface, circles_of(surface.loops), surface.uv, surface.uv, points, places, false, context);
    EXPECT_LT((map.uv.topRows(surface.uv.rows()) - surface.uv).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(LandmarkMap, what_excludes_itself_is_named)
{
    const MappedSurface surface = flat_domain(400);
    const std::vector<SurfacePoint> points{{10, {0.2, 0.5, 0.3}}, {10, {0.2, 0.5, 0.3}}};
    ExecutionContext context;
    try {
        map_with_landmarks(surface, circles_of(surface.loops), surface.uv, surface.uv, points,
                           (VectorXcd(2) << Complex(0.1, 0.0), Complex(0.0, 0.1)).finished(), false, context);
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.elements(), (std::vector<Index>{0, 1}));
        EXPECT_EQ(error.elements_of(), ElementKind::landmarks);
    }
}

TEST(SurfacePoint, of_positions_and_vertices)
{
    const CircleDomain domain = test::make_circle_domain(test::five_circles(), 400);
    const Vertices vertices = test::lift(domain.points, test::Lift::sphere);
    const Eigen::RowVector3d inside = 0.2 * vertices.row(domain.triangles(5, 0)) +
                                      0.5 * vertices.row(domain.triangles(5, 1)) +
                                      0.3 * vertices.row(domain.triangles(5, 2));
    const auto found = surface_points(vertices, domain.triangles, {{7, {}}, {-1, inside}});
    EXPECT_LT((found[0].of(vertices, domain.triangles) - vertices.row(7)).norm(), 1e-15);
    EXPECT_EQ(found[1].face, 5);
    EXPECT_LT((found[1].weights - Eigen::RowVector3d(0.2, 0.5, 0.3)).norm(), 1e-9);
    EXPECT_THROW(surface_points(vertices, domain.triangles, {{-1, {9.0, 0.0, 0.0}}}), InputError);
    EXPECT_THROW(surface_points(vertices, domain.triangles, {{static_cast<Index>(vertices.rows()), {}}}), InputError);
}
