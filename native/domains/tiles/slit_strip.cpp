#include "tiles/slit_strip.h"

#include "core/connectivity.h"
#include "core/errors.h"
#include "surface/curvature_weights.h"
#include "tiles/floating_loops.h"
#include "tiles/rim_bends.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

namespace koebe {
namespace {

/// Integral of |du + form|^2.
double energy(const PeriodicSurface& domain, const VectorXd& u, const OneForm& form)
{
    return squared_norm(curvature_weights(domain.metric, domain.surface.vertex_count),
                        form + exterior_derivative(domain.metric.triangles, u));
}

/// The vertex near an extreme one that is the slit's tip: on the edges before and after it, the surface must lie on
/// opposite sides of the slit, as their faces' other corners tell.
/// @param side of the edge from each vertex to the next: how far that corner lies left of a slit that runs upward
Eigen::Index tip_near(Eigen::Index extreme, const VectorXd& side, double sign)
{
    const Eigen::Index m = side.size();
    Eigen::Index best = extreme;
    int fewest = 5;
    for (const Eigen::Index offset : {0, -1, 1}) {
        int wrong = 0;
        for (Eigen::Index e = -2; e < 2; ++e)
            wrong += (e < offset ? 1.0 : -1.0) * sign * side[(extreme + e + m) % m] > 0.0 ? 0 : 1;
        if (wrong >= fewest) continue;
        fewest = wrong;
        best = (extreme + offset + m) % m;
    }
    return best;
}

/// Moves a slit's vertices along it so that its ends are at tips. A tip usually lies between two vertices, and a face
/// on the edge between them would have no area. So one of them moves to the peak of the parabola through the extreme
/// vertex and its neighbours, by O(h^2). Between the tips each side runs in one direction.
/// @param along of at least 4 vertices, changed @param side as above
void sharpen_tips(VectorXd& along, const VectorXd& side)
{
    const Eigen::Index m = along.size();
    const auto turning_point = [&](Eigen::Index b) {
        const double before = along[(b + m - 1) % m], after = along[(b + 1) % m];
        const double bend = 2.0 * along[b] - before - after;
        return bend == 0.0 ? along[b] : along[b] + (after - before) * (after - before) / (8.0 * bend);
    };
    Eigen::Index high = 0, low = 0;
    along.maxCoeff(&high);
    along.minCoeff(&low);
    if (high == low || m < 4) return;
    // A tip between two vertices lies beyond both: at the top of the parabola through three of them.
    const double top = turning_point(high), bottom = turning_point(low);
    high = tip_near(high, side, 1.0);
    low = tip_near(low, side, -1.0);
    if (high == low) return;
    along[high] = top;
    along[low] = bottom;
    // On both sides the vertices run in order from tip to tip, a least distance apart.
    for (const Eigen::Index step : {Eigen::Index{1}, m - 1}) {
        std::vector<Eigen::Index> way;
        for (Eigen::Index b = high; b != low; b = (b + step) % m) way.push_back(b);
        way.push_back(low);
        const double least = 1e-3 * (top - bottom) / static_cast<double>(m);
        for (std::size_t i = 1; i + 1 < way.size(); ++i)
            along[way[i]] = std::min(along[way[i]], along[way[i - 1]] - least);
        for (std::size_t i = way.size() - 2; i > 0; --i)
            along[way[i]] = std::max(along[way[i]], along[way[i + 1]] + least);
    }
}

/// How far the corners opposite to a slit's edges lie to its left.
VectorXd sides_of(const PeriodicSurface& domain, const VectorXcd& z, std::size_t k, bool along_u)
{
    const Triangles& triangles = domain.surface.triangles;
    const VertexLoop& loop = domain.loops[k];
    std::vector<Index> place(domain.surface.vertex_count, -1);
    for (std::size_t b = 0; b < loop.size(); ++b) place[loop[b]] = static_cast<Index>(b);
    VectorXd side = VectorXd::Zero(static_cast<Eigen::Index>(loop.size()));
    for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h) {
        const Index a = origin(triangles, h), back = previous_halfedge(h);
        if (domain.surface.twin[h] != no_twin || place[a] < 0) continue;
        const Complex arm = z[origin(triangles, back)] - z[a] - domain.shifts[0][back];
        side[place[a]] = along_u ? arm.imag() : -arm.real();
    }
    return side;
}

/// Integral of |du + turns * shift|^2 over the faces of the surface: infinite if u is not constant on a face without
/// area.
double energy_on_faces(const PeriodicSurface& domain, const VectorXd& u, double turns)
{
    const Triangles& triangles = domain.surface.triangles;
    double sum = 0.0;
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f) {
        const auto [a, b, c] = std::array{triangles(f, 0), triangles(f, 1), triangles(f, 2)};
        const Eigen::RowVector3d ab = domain.vertices.row(b) - domain.vertices.row(a);
        const Eigen::RowVector3d ac = domain.vertices.row(c) - domain.vertices.row(a);
        const double along_ab = u[b] - u[a] + turns * domain.shifts[0][3 * f];
        const double along_ac = u[c] - u[a] - turns * domain.shifts[0][3 * f + 2];
        const double slope = (along_ab * ac - along_ac * ab).squaredNorm();
        if (slope > 0.0) sum += 0.5 * slope / ab.cross(ac).norm();
    }
    return sum;
}

}  // namespace

ModulusBounds modulus_bounds(const PeriodicSurface& domain, RingHoles holes)
{
    const VectorXd f = FloatingLoops(domain, holes != RingHoles::radial).between_rims();
    const VectorXd g = FloatingLoops(domain, holes != RingHoles::concentric).round();
    return {1.0 / energy_on_faces(domain, f, 0.0), energy_on_faces(domain, g, 1.0)};
}

FlatMap slit_strip(const PeriodicSurface& domain, RingHoles holes, double& height)
{
    const VectorXd f = FloatingLoops(domain, holes == RingHoles::concentric).between_rims();
    const VectorXd g = FloatingLoops(domain, holes == RingHoles::radial).round();
    // The conjugate function of g has the same energy.
    const OneForm none = OneForm::Zero(static_cast<Eigen::Index>(domain.metric_shifts[0].size()));
    height = std::sqrt(energy(domain, g, domain.metric_shifts[0]) / energy(domain, f, none));
    if (!std::isfinite(height) || !(height > 0.0))
        throw SolverError("the ring has no height: the metric is degenerate");
    FlatMap map;
    map.periods = {1.0};
    map.z = g + Complex(0.0, height) * f;
    VectorXcd places = map.z;
    std::vector<char> moved = boundary_mask(domain.surface);
    for (std::size_t k = domain.first_hole; k < domain.loops.size(); ++k) {
        const VectorXcd loop = gather_loop(map.z, domain.loops[k]);
        VectorXd along = loop.imag();
        if (holes == RingHoles::concentric) along = loop.real();
        sharpen_tips(along, sides_of(domain, map.z, k, holes == RingHoles::concentric));
        for (Eigen::Index b = 0; b < along.size(); ++b) {
            Complex& place = places[domain.loops[k][static_cast<std::size_t>(b)]];
            place =
                holes == RingHoles::concentric ? Complex(along[b], loop[0].imag()) : Complex(loop[0].real(), along[b]);
        }
    }
    bend_rims(domain, places, map);
    move_boundary(domain, places, moved, map.z);
    return map;
}

}  // namespace koebe
