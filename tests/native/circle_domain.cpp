#include "circle_domain.h"

#include "circles/circle_fit.h"
#include "planar/planar_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace koebe::test {
namespace {

/// Consecutive indices from begin; the points run counter-clockwise, so a hole's loop runs backwards.
VertexLoop loop_indices(Index begin, Index count, bool outer)
{
    VertexLoop loop(count);
    for (Index i = 0; i < count; ++i) loop[i] = begin + (outer ? i : count - 1 - i);
    return loop;
}

}  // namespace

VectorXcd points_on(const Circle& circle, Index count, double skew, int turn)
{
    VectorXcd points(count);
    for (Index i = 0; i < count; ++i) {
        const double t = turn * 2.0 * std::numbers::pi * i / count;
        points[i] = circle.center + std::polar(circle.radius, t + skew * std::sin(t));
    }
    return points;
}

Index vertex_near(const CircleDomain& domain, Complex place)
{
    Index nearest = 0;
    (domain.points.array() - place).abs().minCoeff(&nearest);
    return nearest;
}

std::vector<Circle> five_circles()
{
    return {{{0.0, 0.0}, 1.0}, {{0.45, 0.25}, 0.18}, {{-0.4, 0.35}, 0.22}, {{-0.1, -0.5}, 0.2}, {{0.42, -0.4}, 0.12}};
}

CircleDomain make_circle_domain(const std::vector<Circle>& circles, Index target_faces)
{
    double area = 0.0;
    for (std::size_t k = 0; k < circles.size(); ++k)
        area += (k == 0 ? 1.0 : -1.0) * std::numbers::pi * circles[k].radius * circles[k].radius;
    // Equilateral faces of area sqrt(3)/4 h^2.
    const double h = std::sqrt(4.0 * area / (std::sqrt(3.0) * target_faces));

    CircleDomain domain;
    domain.circles = circles;
    std::vector<VectorXcd> polygons;
    Index begin = 0;
    for (std::size_t k = 0; k < circles.size(); ++k) {
        const Index count =
            std::max(Index{8}, static_cast<Index>(std::lround(2.0 * std::numbers::pi * circles[k].radius / h)));
        polygons.push_back(points_on(circles[k], count));
        domain.loops.push_back(loop_indices(begin, count, k == 0));
        begin += count;
    }
    PlanarMesh mesh = planar_mesh(polygons, {.longest = h, .gradation = 1.0, .smoothing = 12});
    domain.points = std::move(mesh.points);
    domain.triangles = std::move(mesh.triangles);
    return domain;
}

CircleDomain eccentric_annulus(Index faces)
{
    return make_circle_domain({{{0.0, 0.0}, 1.0}, {{0.4, 0.2}, 0.25}}, faces);
}

CircleDomain make_round_annulus(double inner, Index sectors, Index rings)
{
    CircleDomain domain;
    domain.circles = {{{0.0, 0.0}, 1.0}, {{0.0, 0.0}, inner}};
    domain.points.resize(sectors * (rings + 1));
    for (Index ring = 0; ring <= rings; ++ring)
        domain.points.segment(ring * sectors, sectors) =
            points_on({{0.0, 0.0}, std::pow(inner, static_cast<double>(ring) / rings)}, sectors);
    domain.triangles.resize(2 * sectors * rings, 3);
    Index f = 0;
    for (Index ring = 0; ring < rings; ++ring)
        for (Index i = 0; i < sectors; ++i) {
            const Index a = ring * sectors + i, b = ring * sectors + (i + 1) % sectors;
            domain.triangles.row(f++) << a, b, b + sectors;
            domain.triangles.row(f++) << a, b + sectors, a + sectors;
        }
    domain.loops = {loop_indices(0, sectors, true), loop_indices(rings * sectors, sectors, false)};
    return domain;
}

std::string to_string(Lift lift)
{
    switch (lift) {
    case Lift::plane: return "plane";
    case Lift::polynomial: return "polynomial";
    case Lift::sphere: return "sphere";
    case Lift::enneper: return "Enneper";
    }
    return "";
}

Vertices lift(const VectorXcd& points, Lift kind)
{
    Vertices vertices(points.size(), 3);
    for (Eigen::Index i = 0; i < points.size(); ++i) {
        const Complex z = points[i];
        const double u = z.real(), v = z.imag();
        switch (kind) {
        case Lift::plane: vertices.row(i) << u, v, 0.0; break;
        case Lift::polynomial: {
            const Complex w = z + 0.3 * z * z + Complex(0.0, 0.05) * z * z * z;
            vertices.row(i) << w.real(), w.imag(), 0.0;
            break;
        }
        case Lift::sphere: {
            // Seen from outside the sphere the projection from its far pole keeps the orientation.
            const double s = 1.0 + std::norm(z);
            vertices.row(i) << 2.0 * u / s, 2.0 * v / s, (1.0 - std::norm(z)) / s;
            break;
        }
        case Lift::enneper:
            vertices.row(i) << u - u * u * u / 3.0 + u * v * v, v - v * v * v / 3.0 + v * u * u, u * u - v * v;
            break;
        }
    }
    return vertices;
}

double inversive_distance_error(const std::vector<Circle>& found, const std::vector<Circle>& expected)
{
    double worst = 0.0;
    for (std::size_t i = 0; i < expected.size(); ++i)
        for (std::size_t j = i + 1; j < expected.size(); ++j) {
            const double exact = inversive_distance(expected[i], expected[j]);
            worst = std::max(worst, std::abs(inversive_distance(found[i], found[j]) - exact) / exact);
        }
    return worst;
}

}  // namespace koebe::test
