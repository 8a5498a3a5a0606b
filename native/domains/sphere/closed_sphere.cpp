#include "sphere/closed_sphere.h"

#include "core/connectivity.h"
#include "core/errors.h"
#include "core/types.h"
#include "execution/each_in_pieces.h"
#include "execution/stopwatch.h"
#include "linear/sparse_cholesky.h"
#include "mesh/nearest_first.h"
#include "sphere/spherical_balance.h"
#include "sphere/spherical_points.h"
#include "surface/intrinsic_metric.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace koebe {
namespace {

/// Vertices, the surface's first, and faces.
struct Polyhedron {
    Vertices vertices;
    Triangles triangles;
};

/// Splits edges in two, and their faces in two to four; faces stay flat.
/// @param too_long takes an edge's ends @return whether an edge was split
bool split_edges(Polyhedron& mesh, const std::function<bool(Index, Index)>& too_long)
{
    const auto is_long = [&](Index h) { return too_long(origin(mesh.triangles, h), target(mesh.triangles, h)); };
    if (found_in_pieces(static_cast<Index>(mesh.triangles.size()), is_long).empty()) return false;
    std::map<std::pair<Index, Index>, Index> middle;
    std::vector<Eigen::RowVector3d> added;
    std::vector<std::array<Index, 3>> faces;
    const Index first = static_cast<Index>(mesh.vertices.rows());
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
        std::array<Index, 3> v{}, half{};
        for (int k = 0; k < 3; ++k) {
            const Index a = mesh.triangles(f, k), b = mesh.triangles(f, (k + 1) % 3);
            v[static_cast<std::size_t>(k)] = a;
            half[static_cast<std::size_t>(k)] = -1;
            if (!too_long(a, b)) continue;
            const auto [at, is_new] = middle.try_emplace(std::minmax(a, b), first + static_cast<Index>(added.size()));
            if (is_new) added.emplace_back(0.5 * (mesh.vertices.row(a) + mesh.vertices.row(b)));
            half[static_cast<std::size_t>(k)] = at->second;
        }
        const auto count = std::ranges::count_if(half, [](Index h) { return h >= 0; });
        // Turn the face so that the first edge is split, or the first and the second.
        std::size_t turn = 0;
        while (count > 0 && !(half[turn] >= 0 && (count == 1 || half[(turn + 1) % 3] >= 0))) ++turn;
        std::rotate(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(turn), v.end());
        std::rotate(half.begin(), half.begin() + static_cast<std::ptrdiff_t>(turn), half.end());
        if (count == 0) {
            faces.push_back(v);
        } else if (count == 1) {
            faces.push_back({v[0], half[0], v[2]});
            faces.push_back({half[0], v[1], v[2]});
        } else if (count == 2) {
            faces.push_back({half[0], v[1], half[1]});
            faces.push_back({v[0], half[0], half[1]});
            faces.push_back({v[0], half[1], v[2]});
        } else {
            faces.push_back({v[0], half[0], half[2]});
            faces.push_back({half[0], v[1], half[1]});
            faces.push_back({half[2], half[1], v[2]});
            faces.push_back({half[0], half[1], half[2]});
        }
    }
    mesh.vertices.conservativeResize(first + static_cast<Eigen::Index>(added.size()), 3);
    for (std::size_t i = 0; i < added.size(); ++i) mesh.vertices.row(first + static_cast<Index>(i)) = added[i];
    mesh.triangles.resize(static_cast<Eigen::Index>(faces.size()), 3);
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k)
            mesh.triangles(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(k)) = faces[f][k];
    return true;
}

constexpr double longest_side = 0.25;        // on the sphere: longer edges are split
constexpr double longest_coarse_side = 0.1;  // for a mesh of few faces
constexpr Eigen::Index few_faces = 500;
constexpr int most_splits = 10;
constexpr Index most_added_faces = 30000;
constexpr double overlap = 0.5;  // height by which each cap reaches beyond the equator: 30 degrees
constexpr std::size_t tried_faces = 8;
constexpr std::size_t opened_at_a_time = 4;  // of them: one pass through the factor serves all

/// Area over the sum of the squared edges: larger is rounder.
double shape_of(const EdgeLengths& lengths, Index f)
{
    const double squares = lengths.row(f).squaredNorm();
    return squares > 0.0 ? triangle_area(lengths(f, 0), lengths(f, 1), lengths(f, 2)) / squares : 0.0;
}

/// Well shaped faces at vertices far from each other along edges.
std::vector<Index> faces_to_open(const IntrinsicMetric& metric, const Vertices& vertices)
{
    const Index count = static_cast<Index>(vertices.rows());
    std::vector<Index> leaving(static_cast<std::size_t>(count));  // a half-edge that starts at each vertex
    for (Index h = 0; h < static_cast<Index>(metric.twin.size()); ++h) leaving[origin(metric.triangles, h)] = h;
    const auto each_leaving = [&](Index v, const auto& visit) {
        Index h = leaving[v];
        do {
            visit(h);
            h = metric.twin[previous_halfedge(h)];
        } while (h != leaving[v]);
    };
    const auto best_face = [&](Index v) {
        Index best = face_of(leaving[v]);
        each_leaving(v, [&](Index h) {
            const double more = shape_of(metric.lengths, face_of(h)) - shape_of(metric.lengths, best);
            if (more > 0.0 || (more == 0.0 && face_of(h) < best)) best = face_of(h);
        });
        return best;
    };
    const Eigen::RowVector3d middle = vertices.colwise().mean();
    Eigen::Index at = 0;
    (vertices.rowwise() - middle).rowwise().squaredNorm().maxCoeff(&at);
    NearestFirst nearest(count);
    std::vector<Index> faces;
    while (faces.size() < std::min<std::size_t>(tried_faces, static_cast<std::size_t>(count))) {
        if (const Index best = best_face(static_cast<Index>(at)); std::ranges::find(faces, best) == faces.end())
            faces.push_back(best);
        nearest.reach(static_cast<Index>(at), 0.0);
        for (Index v = nearest.take(); v >= 0; v = nearest.take())
            each_leaving(v, [&](Index h) {
                nearest.reach(target(metric.triangles, h), nearest.distance()[v] + metric.lengths.data()[h]);
            });
        if (!(VectorXd::Map(nearest.distance().data(), count).maxCoeff(&at) > 0.0)) break;
    }
    return faces;
}

/// Adds the loads of u and v, two columns, of the function with a dipole in a face.
void add_dipole_load(const IntrinsicMetric& metric, Index f, Eigen::Ref<MatrixXd> load)
{
    const double along = metric.lengths(f, 0), back = metric.lengths(f, 2), other = metric.lengths(f, 1);
    const double x = (along * along + back * back - other * other) / (2.0 * along);
    const double height = 2.0 * triangle_area(along, other, back) / along;
    const Index a = metric.triangles(f, 0), b = metric.triangles(f, 1), c = metric.triangles(f, 2);
    const double share = x / along;
    load(a, 0) -= 1.0 / along;
    load(b, 0) += 1.0 / along;
    load(a, 1) += (1.0 - share) / height;
    load(b, 1) += share / height;
    load(c, 1) -= 1.0 / height;
}

std::size_t turned_count(const Triangles& triangles, const VectorXcd& z)
{
    const Vertices points = on_sphere(z);
    std::atomic<std::size_t> turned = 0;
    each_in_pieces(triangles.rows(), [&](Eigen::Index f) {
        const SpherePoint a = points.row(triangles(f, 0)), b = points.row(triangles(f, 1)),
                          c = points.row(triangles(f, 2));
        if (!(a.dot((b - a).cross(c - a)) > 0.0)) ++turned;
    });
    return turned;
}

/// One of two caps: harmonic inside, with given rim.
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

/// 1 / z, with a far point for z = 0.
VectorXcd reciprocal(const VectorXcd& z)
{
    return z.unaryExpr([](Complex at) { return std::abs(at) > 1e-150 ? 1.0 / at : Complex(1e150, 0.0); });
}

/// Rotates a map as near as possible to an earlier one. @return the largest remaining move
double turned_towards(const VectorXcd& from, VectorXcd& to, const VectorXd& weights)
{
    const Vertices old = on_sphere(from);
    Vertices now = on_sphere(to);
    const Eigen::Matrix3d turn = best_rotation(now, old, weights);
    each_in_pieces(to.size(), [&](Eigen::Index v) {
        now.row(v) = (turn * now.row(v).transpose()).transpose();
        to[v] = in_plane(now.row(v).transpose());
    });
    return (now - old).rowwise().norm().maxCoeff();
}

/// The metric of a polyhedron and its first map.
struct OpenedSphere {
    SparseMatrix laplacian;
    VectorXd areas;
    VectorXcd z;
    std::size_t turned = std::numeric_limits<std::size_t>::max();  // faces
};

/// @param surface of the mesh's faces @param seconds added to
OpenedSphere open_sphere(const Polyhedron& mesh, const Surface& surface, StageSeconds& seconds,
                         const ExecutionContext& context)
{
    OpenedSphere sphere;
    Stopwatch stage;
    const Index count = static_cast<Index>(mesh.vertices.rows());
    const IntrinsicMetric metric = intrinsic_metric(mesh.vertices, surface);
    sphere.laplacian = cotan_laplacian(metric.triangles, half_cotangents(metric.lengths), count);
    sphere.areas = vertex_areas(mesh.triangles, edge_lengths(mesh.vertices, mesh.triangles), count);
    if (!(sphere.areas.sum() > 0.0)) sphere.areas.setOnes();
    seconds.metric += stage.lap();
    SparseMatrix tied = sphere.laplacian;  // constants are in the kernel: a load with sum 0 draws nothing from the tie
    tied.coeffRef(0, 0) += tied.diagonal().mean();
    const SparseCholesky factor(tied);
    tied = {};
    seconds.factor += stage.lap();
    const std::vector<Index> faces = faces_to_open(metric, mesh.vertices);
    double least = 0.0;
    for (std::size_t first = 0; first < faces.size(); first += opened_at_a_time) {
        const std::size_t some = std::min(opened_at_a_time, faces.size() - first);
        MatrixXd maps = MatrixXd::Zero(count, static_cast<Eigen::Index>(2 * some));
        for (std::size_t i = 0; i < some; ++i)
            add_dipole_load(metric, faces[first + i], maps.middleCols(static_cast<Eigen::Index>(2 * i), 2));
        maps = factor.solve(maps);
        for (std::size_t i = 0; i < some; ++i) {
            context.checkpoint();
            const auto u = maps.middleCols(static_cast<Eigen::Index>(2 * i), 2);
            if (!u.allFinite()) continue;
            VectorXcd opened(count);
            opened.real() = u.col(0);
            opened.imag() = u.col(1);
            const double size = opened.cwiseAbs().maxCoeff();
            if (!(size > 0.0) || !std::isfinite(size)) continue;
            opened /= size;
            opened = balance_on_sphere(opened, sphere.areas).move(opened);
            const std::size_t turned = turned_count(mesh.triangles, opened);
            const double unevenness = spherical_unevenness(opened, sphere.areas, {});
            if (!opened.allFinite()) continue;
            if (turned > sphere.turned || (turned == sphere.turned && unevenness >= least)) continue;
            sphere.turned = turned;
            least = unevenness;
            sphere.z = std::move(opened);
        }
    }
    if (sphere.z.size() == 0) throw SolverError("no finite map to the sphere: the metric is degenerate");
    seconds.iterate += stage.lap();
    return sphere;
}

/// Opens the sphere as open_sphere, and splits edges until all are short on the sphere.
/// @param surface of the mesh's faces before any split @param seconds added to
OpenedSphere open_refined_sphere(Polyhedron& mesh, const Surface& surface, StageSeconds& seconds,
                                 ExecutionContext& context)
{
    const Eigen::Index most = mesh.triangles.rows() + most_added_faces;
    const double longest = mesh.triangles.rows() < few_faces ? longest_coarse_side : longest_side;
    OpenedSphere sphere = open_sphere(mesh, surface, seconds, context);
    for (int round = 0; round < most_splits && mesh.triangles.rows() < most; ++round) {
        context.advance(0.05 * (round + 1));
        const Vertices points = on_sphere(sphere.z);
        if (!split_edges(mesh, [&](Index a, Index b) { return (points.row(a) - points.row(b)).norm() > longest; }))
            break;
        sphere = open_sphere(mesh, analyze_surface(mesh.triangles, static_cast<Index>(mesh.vertices.rows())), seconds,
                             context);
    }
    return sphere;
}

}  // namespace

ClosedSphereMap closed_sphere_map(const PeriodicSurface& domain, const VectorXd& weights,
                                  const IterationOptions& options, ExecutionContext& context)
{
    Polyhedron mesh{domain.vertices, domain.surface.triangles};
    ClosedSphereMap map;
    OpenedSphere sphere = open_refined_sphere(mesh, domain.surface, map.seconds, context);
    Stopwatch stage;
    const SparseMatrix& laplacian = sphere.laplacian;
    const VectorXd& areas = sphere.areas;
    std::size_t fewest = sphere.turned;
    VectorXcd z = std::move(sphere.z);
    const Index count = static_cast<Index>(mesh.vertices.rows());

    // Two caps that overlap at the equator, each a Dirichlet problem in its own stereographic chart.
    const Vertices start = on_sphere(z);
    std::vector<char> south(static_cast<std::size_t>(count)), north(static_cast<std::size_t>(count));
    for (Index v = 0; v < count; ++v) {
        south[v] = start(v, 2) <= -overlap ? 1 : 0;
        north[v] = start(v, 2) >= overlap ? 1 : 0;
    }
    const CapChart upper(laplacian, south), lower(laplacian, north);
    map.seconds.factor += stage.lap();
    // Alternating Schwarz: z, then 1 / z, each harmonic inside its cap with the other cap's values on the rim. A
    // Moebius map then balances the areas, and a turn lays the map over the last one.
    VectorXcd best = z;
    double least_change = std::numeric_limits<double>::infinity();
    for (int sweep = 0; sweep < options.max_sweeps && !map.converged; ++sweep) {
        context.advance(0.5 + 0.5 * sweep / (sweep + 4.0));
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
        const double change = turned_towards(z, next, areas);
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
    // The vertices of the surface without those that were added, balanced among themselves.
    map.z = best.head(domain.surface.vertex_count);
    map.z = balance_on_sphere(map.z, weights).move(map.z);
    map.seconds.iterate += stage.lap();
    return map;
}

}  // namespace koebe
