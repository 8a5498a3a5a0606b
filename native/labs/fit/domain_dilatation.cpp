#include "fit/domain_dilatation.h"

#include "bending/bend_between.h"
#include "core/errors.h"
#include "core/numbering.h"
#include "fit/plane_beltrami.h"
#include "fit/quasiconformal_map.h"
#include "planar/planar_mesh.h"
#include "shape/conformal_module.h"
#include "shape/domain_alignment.h"
#include "shape/separation_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

namespace koebe {
namespace {

constexpr double outer_edges = 96.0;                          // of the unit circle, where no gap asks for more
constexpr double most_hole_edges = 72.0, least_edges = 12.0;  // of a hole
constexpr double edges_of_holes = 1600.0;                     // of all holes together, about
constexpr double edges_across_gap = 2.0;                      // between two rims
constexpr double gradation = 0.1, fine_gradation = 0.07;      // of the mesh: growth of edges per distance from rims
constexpr int samples = 720;                                  // of a rim, to measure gaps
constexpr double alike = 1e-9;                                // relative: sums that differ by rounding

/// The distance from a point of circle k's rim to the nearest other rim.
double gap_at(const std::vector<Circle>& circles, std::size_t k, Complex point)
{
    double gap = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < circles.size(); ++j)
        if (j != k) gap = std::min(gap, std::abs(std::abs(point - circles[j].center) - circles[j].radius));
    return gap;
}

/// Points of a rim. Their density goes with 1 over the edge length that the radius and the gap ask for.
VectorXcd rim_points(const std::vector<Circle>& circles, std::size_t k)
{
    const Circle& circle = circles[k];
    const double holes = static_cast<double>(circles.size()) - 1.0;
    const double edges = k == 0 ? outer_edges : std::clamp(edges_of_holes / holes, least_edges, most_hole_edges);
    const auto place = [&](double angle) { return circle.center + std::polar(circle.radius, angle); };
    // The number of edges up to each angle: the integral of the density.
    std::vector<double> sums{0.0};
    constexpr double step = 2.0 * std::numbers::pi / samples;
    for (int i = 0; i < samples; ++i) {
        const double wide = 2.0 * std::numbers::pi / edges;
        const double narrow = gap_at(circles, k, place((i + 0.5) * step)) / (edges_across_gap * circle.radius);
        sums.push_back(sums.back() + step / std::min(wide, narrow));
    }
    const auto count = static_cast<Eigen::Index>(std::ceil(sums.back()));
    VectorXcd points(count);
    for (Eigen::Index i = 0, at = 0; i < count; ++i) {
        const double wanted = static_cast<double>(i) / static_cast<double>(count) * sums.back();
        while (sums[static_cast<std::size_t>(at) + 1] <= wanted) ++at;
        const double below = sums[static_cast<std::size_t>(at)], above = sums[static_cast<std::size_t>(at) + 1];
        points[i] = place((static_cast<double>(at) + (wanted - below) / (above - below)) * step);
    }
    return points;
}

/// A mesh of a circle domain, and its rims with the surface on their left.
struct DomainMesh {
    Triangles triangles;
    PlanarPoints uv;
    std::vector<VertexLoop> loops;
};

DomainMesh mesh_of(const std::vector<Circle>& circles, double gradation)
{
    DomainMesh mesh;
    std::vector<VectorXcd> polygons;
    Index first = 0;
    for (std::size_t k = 0; k < circles.size(); ++k) {
        polygons.push_back(rim_points(circles, k));
        VertexLoop& loop = mesh.loops.emplace_back(static_cast<std::size_t>(polygons.back().size()));
        std::iota(loop.begin(), loop.end(), first);
        first += static_cast<Index>(loop.size());
        if (k > 0) std::reverse(loop.begin() + 1, loop.end());
    }
    PlanarMesh planar = planar_mesh(polygons, {.gradation = gradation});
    mesh.triangles = std::move(planar.triangles);
    mesh.uv.resize(planar.points.size(), 2);
    mesh.uv << planar.points.real(), planar.points.imag();
    return mesh;
}

/// Bounds of maps whose |mu| is constant and whose direction is that of q, from the best q of the map before, until the
/// bounds no longer come nearer to each other.
/// @param from the mesh's circles @param bounds of a map of the mesh onto the goal
/// @return the nearest bounds; nothing if no such map was one to one
std::optional<DilatationBounds> sharpened(const DomainMesh& mesh, const std::vector<Circle>& from,
                                          const std::vector<Circle>& goal, DilatationBounds bounds,
                                          ExecutionContext& context)
{
    constexpr int most_rounds = 8;
    constexpr double least_gain = 0.9;  // of the gap between the bounds, in logarithms
    std::optional<DilatationBounds> best;
    double least_gap = std::numeric_limits<double>::infinity();
    for (int round = 0; round < most_rounds && bounds.q.size() > 0; ++round) {
        // mu = k conj(q) / |q|
        const double k = (bounds.dilatation() - 1.0) / (bounds.dilatation() + 1.0);
        const VectorXd size = bounds.q.cwiseAbs().cwiseMax(std::numeric_limits<double>::min());
        VectorXcd mu = k * bounds.q.conjugate().cwiseQuotient(size.cast<Complex>());
        const auto uv = quasiconformal_map(mesh.triangles, mesh.uv, mesh.loops, mu, goal, context);
        if (!uv) break;
        // The bounds of the map onto the goal, unless it turns a face over.
        mu = plane_beltrami(mesh.uv, mesh.triangles, *uv);
        if (!(mu.cwiseAbs().maxCoeff() < 1.0)) break;
        bounds = dilatation_bounds(mesh.triangles, mesh.uv, from, mesh.loops, {}, mu);
        const double last = least_gap, gap = std::log(bounds.upper / bounds.lower);
        if (gap < last) {
            best = bounds;
            least_gap = gap;
        }
        if (!(gap < least_gain * last)) break;
    }
    return best;
}

/// Bends the first domain onto the second one. @throws SolverError no one-to-one map was found
DilatationBounds bounds_one_way(const std::vector<Circle>& first, const std::vector<Circle>& second,
                                ExecutionContext& context)
{
    const DomainAlignment alignment = align_domains(second, first, numbers_below<int>(first.size()), context);
    std::vector<Circle> from{Circle{}};
    for (std::size_t k = 1; k < first.size(); ++k) from.push_back(alignment.map(first[k]));
    // A finer mesh and higher powers of |mu| only where the first map is too uneven.
    DilatationBounds bounds{.lower = 1.0, .upper = std::numeric_limits<double>::infinity(), .q = {}};
    for (const bool again : {false, true}) {
        const DomainMesh mesh = mesh_of(from, again ? fine_gradation : gradation);
        const std::vector<Index> none;
        const BendingInput input{mesh.triangles,
                                 mesh.loops,
                                 none,
                                 mesh.uv,
                                 mesh.uv,
                                 VectorXd::Ones(mesh.triangles.rows()),
                                 std::vector<TemplateRim>(from.size())};
        Extremal extremal{.powers = {2.0}, .free_rims = true};
        if (again) extremal.powers = {2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0};
        const BendingResult bent = bend_between(input, from, second, extremal, context);
        if (!bent.arrived)
            throw SolverError("no one-to-one map of one circle domain to the other was found: faces turn over",
                              ElementKind::loops, bent.blocked);
        const DilatationBounds start = dilatation_bounds(mesh.triangles, mesh.uv, from, mesh.loops, {},
                                                         plane_beltrami(mesh.uv, mesh.triangles, bent.uv));
        if (auto sharp = sharpened(mesh, from, second, start, context)) return *std::move(sharp);
        if (start.upper / start.lower < bounds.upper / bounds.lower) bounds = start;
    }
    return bounds;
}

/// Whether numbers come before others, if differences of rounding do not count.
bool comes_before(const std::vector<double>& a, const std::vector<double>& b)
{
    for (std::size_t i = 0; i < a.size(); ++i)
        if (std::abs(a[i] - b[i]) > alike * std::max(std::abs(a[i]), std::abs(b[i]))) return a[i] < b[i];
    return true;
}

/// Numbers of a domain that tell it from any other: the sum of its separations, and its module in this order.
std::vector<double> numbers_of(const std::vector<Circle>& circles)
{
    std::vector<double> numbers{conformal_separations(circles).sum()};
    const VectorXd module = conformal_module(circles);
    numbers.insert(numbers.end(), module.begin(), module.end());
    return numbers;
}

}  // namespace

double separation_bound(const std::vector<Circle>& a, const std::vector<Circle>& b)
{
    const MatrixXd here = conformal_separations(a), there = conformal_separations(b);
    double bound = 1.0;
    for (Eigen::Index i = 0; i < here.rows(); ++i)
        for (Eigen::Index j = 0; j < i; ++j)
            bound = std::max({bound, here(i, j) / there(i, j), there(i, j) / here(i, j)});
    return bound;
}

DilatationBounds domain_dilatation(const std::vector<Circle>& a, const std::vector<Circle>& b,
                                   ExecutionContext& context)
{
    // Both ways take the loops in one order, and the domains too.
    std::vector<std::size_t> order = numbers_below<std::size_t>(a.size());
    std::vector<double> apart(a.size(), 0.0);
    for (std::size_t k = 1; k < a.size(); ++k)
        apart[k] = conformal_separation(a[0], a[k]) + conformal_separation(b[0], b[k]);
    std::ranges::stable_sort(order, {}, [&](std::size_t k) { return apart[k]; });
    std::vector<Circle> first, second;
    for (const std::size_t k : order) {
        first.push_back(a[k]);
        second.push_back(b[k]);
    }
    if (!comes_before(numbers_of(first), numbers_of(second))) std::swap(first, second);
    DilatationBounds bounds;
    try {
        bounds = bounds_one_way(first, second, context);
    } catch (const OutOfMemory&) {
        throw;
    } catch (const SolverError&) {
        bounds = bounds_one_way(second, first, context);
    }
    bounds.lower = std::max(bounds.lower, separation_bound(a, b));
    bounds.upper = std::max(bounds.upper, bounds.lower);
    return bounds;
}

}  // namespace koebe
