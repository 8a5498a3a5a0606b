#include "domains/closed_sphere.h"

#include "core/connectivity.h"
#include "core/errors.h"
#include "domains/spherical_balance.h"
#include "domains/spherical_points.h"
#include "linear/sparse_cholesky.h"
#include "surface/intrinsic_metric.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <queue>
#include <utility>

namespace koebe {
namespace {

constexpr Index enough_faces = 2000;  // fewer are refined
constexpr double overlap = 0.5;       // each cap reaches so far beyond the equator, as a height: 30 degrees
constexpr std::size_t tried_faces = 8;

/// Vertices, those of the polyhedron first, and faces.
struct Polyhedron {
    Vertices vertices;
    Triangles triangles;
};

Polyhedron refined_polyhedron(Polyhedron mesh)
{
    while (mesh.triangles.rows() < enough_faces) {
        std::map<std::pair<Index, Index>, Index> middle;
        std::vector<Eigen::RowVector3d> added;
        const Index first = static_cast<Index>(mesh.vertices.rows());
        Triangles finer(4 * mesh.triangles.rows(), 3);
        for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
            std::array<Index, 3> half{};
            for (int k = 0; k < 3; ++k) {
                const Index a = mesh.triangles(f, k), b = mesh.triangles(f, (k + 1) % 3);
                const auto [at, is_new] =
                    middle.try_emplace(std::minmax(a, b), first + static_cast<Index>(added.size()));
                if (is_new) added.emplace_back(0.5 * (mesh.vertices.row(a) + mesh.vertices.row(b)));
                half[static_cast<std::size_t>(k)] = at->second;
            }
            const auto corner = mesh.triangles.row(f);
            finer.row(4 * f) << corner[0], half[0], half[2];
            finer.row(4 * f + 1) << half[0], corner[1], half[1];
            finer.row(4 * f + 2) << half[2], half[1], corner[2];
            finer.row(4 * f + 3) << half[0], half[1], half[2];
        }
        mesh.vertices.conservativeResize(first + static_cast<Eigen::Index>(added.size()), 3);
        for (std::size_t i = 0; i < added.size(); ++i) mesh.vertices.row(first + static_cast<Index>(i)) = added[i];
        mesh.triangles = std::move(finer);
    }
    return mesh;
}

/// Distances along edges from some vertices.
VectorXd edge_distances(const IntrinsicMetric& metric, Index vertex_count, Index source)
{
    std::vector<std::vector<std::pair<Index, double>>> neighbours(static_cast<std::size_t>(vertex_count));
    for (Eigen::Index f = 0; f < metric.triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) {
            const Index a = metric.triangles(f, k), b = metric.triangles(f, (k + 1) % 3);
            neighbours[a].emplace_back(b, metric.lengths(f, k));
            neighbours[b].emplace_back(a, metric.lengths(f, k));
        }
    VectorXd distance = VectorXd::Constant(vertex_count, std::numeric_limits<double>::infinity());
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    distance[source] = 0.0;
    queue.emplace(0.0, source);
    while (!queue.empty()) {
        const auto [far, v] = queue.top();
        queue.pop();
        if (far > distance[v]) continue;
        for (const auto& [w, length] : neighbours[v])
            if (far + length < distance[w]) {
                distance[w] = far + length;
                queue.emplace(distance[w], w);
            }
    }
    return distance;
}

/// Area over the sum of the squared edges: the larger the rounder.
double shape_of(const EdgeLengths& lengths, Eigen::Index f)
{
    const double squares = lengths.row(f).squaredNorm();
    return squares > 0.0 ? triangle_area(lengths(f, 0), lengths(f, 1), lengths(f, 2)) / squares : 0.0;
}

/// Well shaped faces at vertices far from each other.
std::vector<Index> faces_to_open(const IntrinsicMetric& metric, const Vertices& vertices)
{
    const Index count = static_cast<Index>(vertices.rows());
    std::vector<Index> best(static_cast<std::size_t>(count), -1);
    for (Index f = 0; f < static_cast<Index>(metric.triangles.rows()); ++f)
        for (const Index v : metric.triangles.row(f))
            if (best[v] < 0 || shape_of(metric.lengths, f) > shape_of(metric.lengths, best[v])) best[v] = f;
    const Eigen::RowVector3d middle = vertices.colwise().mean();
    Eigen::Index at = 0;
    (vertices.rowwise() - middle).rowwise().squaredNorm().maxCoeff(&at);
    VectorXd nearest = VectorXd::Constant(count, std::numeric_limits<double>::infinity());
    std::vector<Index> faces;
    while (faces.size() < std::min<std::size_t>(tried_faces, static_cast<std::size_t>(count))) {
        if (best[at] >= 0 && std::ranges::find(faces, best[at]) == faces.end()) faces.push_back(best[at]);
        nearest = nearest.cwiseMin(edge_distances(metric, count, static_cast<Index>(at)));
        if (!(nearest.maxCoeff(&at) > 0.0)) break;
    }
    return faces;
}

/// Two columns: what makes u and v of the function with a dipole in a face.
MatrixXd dipole_load(const IntrinsicMetric& metric, Index vertex_count, Index f)
{
    const double along = metric.lengths(f, 0), back = metric.lengths(f, 2), other = metric.lengths(f, 1);
    const double x = (along * along + back * back - other * other) / (2.0 * along);
    const double height = 2.0 * triangle_area(along, other, back) / along;
    const Index a = metric.triangles(f, 0), b = metric.triangles(f, 1), c = metric.triangles(f, 2);
    const double share = x / along;
    MatrixXd load = MatrixXd::Zero(vertex_count, 2);
    load(a, 0) -= 1.0 / along;
    load(b, 0) += 1.0 / along;
    load(a, 1) += (1.0 - share) / height;
    load(b, 1) += share / height;
    load(c, 1) -= 1.0 / height;
    return load;
}

std::size_t turned_count(const Triangles& triangles, const VectorXcd& z)
{
    const Vertices points = on_sphere(z);
    std::size_t turned = 0;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const SpherePoint a = points.row(triangles(f, 0)), b = points.row(triangles(f, 1)),
                          c = points.row(triangles(f, 2));
        turned += a.dot((b - a).cross(c - a)) > 0.0 ? 0 : 1;
    }
    return turned;
}

/// One of two caps: harmonic inside, given on its rim.
class CapChart {
public:
    CapChart(const SparseMatrix& laplacian, const std::vector<char>& fixed)
    {
        inside_ = static_cast<std::size_t>(std::ranges::count(fixed, char{0}));
        if (inside_ > 0 && inside_ < fixed.size()) solver_ = std::make_unique<DirichletSolver>(laplacian, fixed);
    }
    explicit operator bool() const { return solver_ != nullptr; }
    void solve(VectorXcd& z) const
    {
        MatrixXd values(z.size(), 2);
        values << z.real(), z.imag();
        values = solver_->solve(values);
        z.real() = values.col(0);
        z.imag() = values.col(1);
    }

private:
    std::size_t inside_ = 0;
    std::unique_ptr<DirichletSolver> solver_;
};

/// 1 / z, with a far point for 0.
VectorXcd reciprocal(const VectorXcd& z)
{
    return z.unaryExpr([](Complex at) { return std::abs(at) > 1e-150 ? 1.0 / at : Complex(1e150, 0.0); });
}

/// Turned to lie as near to what it was as it can. @return the largest move that is left
double turn_back(const VectorXcd& from, VectorXcd& to, const VectorXd& weights)
{
    const Vertices old = on_sphere(from);
    Vertices now = on_sphere(to);
    now = (now * best_rotation(now, old, weights).transpose()).eval();
    for (Eigen::Index v = 0; v < to.size(); ++v) to[v] = in_plane(now.row(v).transpose());
    return (now - old).rowwise().norm().maxCoeff();
}

}  // namespace

ClosedSphereMap closed_sphere_map(const PeriodicSurface& domain, const VectorXd& weights,
                                  const IterationOptions& options, ExecutionContext& context)
{
    const Polyhedron mesh = refined_polyhedron({domain.vertices, domain.surface.triangles});
    const Index count = static_cast<Index>(mesh.vertices.rows()), own = domain.surface.vertex_count;
    const IntrinsicMetric metric = intrinsic_metric(mesh.vertices, analyze_surface(mesh.triangles, count));
    const SparseMatrix laplacian = cotan_laplacian(metric.triangles, half_cotangents(metric.lengths), count);
    const VectorXd areas =
        count == own ? weights : vertex_areas(mesh.triangles, edge_lengths(mesh.vertices, mesh.triangles), count);
    context.advance(0.1);

    VectorXcd z;
    std::size_t fewest = std::numeric_limits<std::size_t>::max();
    double least = 0.0;
    {
        SparseMatrix tied = laplacian;  // constants are in the kernel: a load without a sum draws nothing from the tie
        tied.coeffRef(0, 0) += laplacian.diagonal().mean();
        const SparseCholesky factor(tied);
        for (const Index f : faces_to_open(metric, mesh.vertices)) {
            context.checkpoint();
            const MatrixXd u = factor.solve(dipole_load(metric, count, f));
            if (!u.allFinite()) continue;
            VectorXcd opened(count);
            opened.real() = u.col(0);
            opened.imag() = u.col(1);
            const double size = opened.cwiseAbs().maxCoeff();
            if (!(size > 0.0) || !std::isfinite(size)) continue;
            opened /= size;
            const SphericalBalance balance = balance_on_sphere(opened, areas);
            opened = balance.move(opened);
            const std::size_t turned = turned_count(mesh.triangles, opened);
            const double unevenness = spherical_unevenness(opened, areas, {});
            if (turned > fewest || (turned == fewest && unevenness >= least)) continue;
            fewest = turned;
            least = unevenness;
            z = std::move(opened);
        }
    }
    if (z.size() == 0) throw SolverError("no finite map to the sphere: the metric is degenerate");

    ClosedSphereMap map;
    const Vertices start = on_sphere(z);
    std::vector<char> south(static_cast<std::size_t>(count)), north(static_cast<std::size_t>(count));
    for (Index v = 0; v < count; ++v) {
        south[v] = start(v, 2) <= -overlap ? 1 : 0;
        north[v] = start(v, 2) >= overlap ? 1 : 0;
    }
    const CapChart upper(laplacian, south), lower(laplacian, north);
    VectorXcd best = z;
    double least_change = std::numeric_limits<double>::infinity();
    for (int sweep = 0; sweep < options.max_sweeps && !map.converged; ++sweep) {
        context.advance(0.3 + 0.7 * sweep / (sweep + 4.0));
        VectorXcd next = z;
        if (upper) upper.solve(next);
        if (lower) {
            next = reciprocal(next);
            lower.solve(next);
            next = reciprocal(next);
        }
        if (!next.allFinite()) break;
        next = balance_on_sphere(next, areas).move(next);
        if (!next.allFinite()) break;
        const double change = turn_back(z, next, areas);
        map.changes.push_back(change);
        map.converged = change < options.tolerance;
        const std::size_t turned = turned_count(mesh.triangles, next);
        z = std::move(next);
        if (turned < fewest || (turned == fewest && change < least_change) || map.converged) {
            fewest = std::min(fewest, turned);
            best = z;
        }
        least_change = std::min(least_change, change);
    }
    map.z = (map.converged ? z : best).head(own);
    map.z = balance_on_sphere(map.z, weights).move(map.z);
    return map;
}

}  // namespace koebe
