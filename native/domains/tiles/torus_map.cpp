#include "circles/boundary_angles.h"
#include "circles/circle_projection.h"
#include "execution/execution.h"
#include "execution/memory_limit.h"
#include "iteration/convergence.h"
#include "iteration/disk_dirichlet_to_neumann.h"
#include "iteration/iteration_options.h"
#include "linear/dense_spd.h"
#include "linear/kept_factor.h"
#include "quality/map_clock.h"
#include "quality/take_verdict.h"
#include "surface/curvature_weights.h"
#include "tiles/flat_map.h"
#include "tiles/tile_map.h"
#include "tiles/tile_result.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace koebe {
namespace {

using std::numbers::pi;

/// The closed torus: the surface with a round disk in each hole.
class FilledTorus {
public:
    explicit FilledTorus(const PeriodicSurface& domain)
        : domain_(domain), weights_(curvature_weights(domain.metric, domain.surface.vertex_count))
    {
        double blocks = 0.0;
        for (const VertexLoop& loop : domain.loops) blocks += std::pow(static_cast<double>(loop.size()), 2);
        require_memory(60.0 * blocks, "the disks in the holes");
        const SparseMatrix laplacian = laplacian_of(domain);
        std::vector<Eigen::Triplet<double, Index>> entries;
        for (Index v = 0; v < static_cast<Index>(laplacian.cols()); ++v)
            for (SparseMatrix::InnerIterator it(laplacian, v); it; ++it)
                if (it.row() >= v) entries.emplace_back(static_cast<Index>(it.row()), v, it.value());
        for (const VertexLoop& loop : domain.loops)
            for (const Index v : loop)
                for (const Index w : loop)
                    if (w >= v) entries.emplace_back(w, v, 0.0);
        // One vertex is tied to 0. Constants are in the kernel, so the tie draws nothing.
        const std::vector<char> boundary = boundary_mask(domain.surface);
        const auto inside = std::ranges::find(boundary, char{0});
        const Index tied = inside == boundary.end() ? 0 : static_cast<Index>(inside - boundary.begin());
        entries.emplace_back(tied, tied, laplacian.diagonal().mean());
        empty_.resize(laplacian.rows(), laplacian.cols());
        empty_.setFromTriplets(entries.begin(), entries.end());
        filled_ = empty_;
        loads_.resize(laplacian.rows(), 2);
        for (int j = 0; j < 2; ++j) loads_.col(j) = jump_load(domain, domain.metric_shifts[j]);
    }

    void set_disks(const std::vector<VectorXd>& angles)
    {
        disks_.clear();
        for (std::size_t k = 0; k < angles.size(); ++k) {
            const VertexLoop& loop = domain_.loops[k];
            const MatrixXd& disk = disks_.emplace_back(disk_dirichlet_to_neumann(angles[k]));
            for (std::size_t c = 0; c < loop.size(); ++c) {
                const Index* rows = filled_.innerIndexPtr() + filled_.outerIndexPtr()[loop[c]];
                const Index* end = filled_.innerIndexPtr() + filled_.outerIndexPtr()[loop[c] + 1];
                for (std::size_t r = 0; r < loop.size(); ++r) {
                    if (loop[r] < loop[c]) continue;
                    const std::ptrdiff_t at = std::lower_bound(rows, end, loop[r]) - filled_.innerIndexPtr();
                    filled_.valuePtr()[at] =
                        empty_.valuePtr()[at] + disk(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c));
                }
            }
        }
    }

    /// (V, 2) the functions that make both shifts harmonic.
    MatrixXd solve()
    {
        MatrixXd u = factored(factor_, filled_).solve(loads_);
        if (!u.allFinite()) throw SolverError("no finite harmonic form: the metric is degenerate");
        return u;
    }

    Eigen::Matrix2d energies(const MatrixXd& u) const
    {
        Eigen::Matrix2d e;
        const Eigen::Map<const VectorXd> w(weights_.data(), weights_.size());
        std::vector<OneForm> forms;
        for (int j = 0; j < 2; ++j)
            forms.push_back(domain_.metric_shifts[j] + exterior_derivative(domain_.metric.triangles, u.col(j)));
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j) {
                e(i, j) = (w.array() * forms[i].array() * forms[j].array()).sum();
                for (std::size_t k = 0; k < disks_.size(); ++k) {
                    const MatrixXd on_loop = u(domain_.loops[k], Eigen::all);
                    e(i, j) += on_loop.col(i).dot(disks_[k] * on_loop.col(j));
                }
            }
        return e;
    }

    void take_loads()
    {
        for (int j = 0; j < 2; ++j) loads_.col(j) = jump_load(domain_, domain_.metric_shifts[j]);
    }

private:
    const PeriodicSurface& domain_;
    EdgeLengths weights_;
    SparseMatrix empty_, filled_;
    MatrixXd loads_;
    std::vector<MatrixXd> disks_;
    KeptFactor factor_;
};

Complex modulus(const Eigen::Matrix2d& energies)
{
    const double determinant = energies.determinant();
    if (!(determinant > 0.0) || !(energies(1, 1) > 0.0) || !std::isfinite(determinant))
        throw SolverError("the periods of the torus span no lattice: the metric is degenerate");
    return {-energies(0, 1) / energies(1, 1), std::sqrt(determinant) / energies(1, 1)};
}

/// Replaces the shifts by a reduced basis of the same lattice (Gauss): |Re tau| <= 1/2, |tau| >= 1.
/// @return the ratio of the new periods
Complex reduce(Complex tau, PeriodicSurface& domain, MatrixXd& u)
{
    const auto each = [&](auto&& change) {
        change(domain.shifts[0], domain.shifts[1]);
        change(domain.metric_shifts[0], domain.metric_shifts[1]);
        VectorXd first = u.col(0), second = u.col(1);
        change(first, second);
        u.col(0) = first;
        u.col(1) = second;
    };
    for (int step = 0; step < 200; ++step) {
        if (const double turns = std::round(tau.real()); turns != 0.0) {
            tau -= turns;
            each([&](VectorXd& first, const VectorXd& second) { first += turns * second; });
        }
        if (std::norm(tau) >= 1.0 - 1e-9) break;
        tau = -1.0 / tau;
        each([](VectorXd& first, VectorXd& second) {
            std::swap(first, second);
            second = -second;
        });
    }
    return tau;
}

/// The ascending angles of an image round its circle; the loop itself runs clockwise.
VectorXd angles_of(const VectorXcd& image, const Circle& circle)
{
    const VectorXcd points = project_onto_circle(circle, image, -1);
    VectorXd angles(points.size());
    angles[0] = 0.0;
    for (Eigen::Index b = 1; b < points.size(); ++b) {
        double step = -std::arg((points[b] - circle.center) / (points[b - 1] - circle.center));
        if (step < 0.0) step += 2.0 * pi;
        angles[b] = angles[b - 1] + step;
    }
    return angles;
}

/// The old angles plus `farthest` times their change to the new ones, or less where the order would break.
VectorXd relaxed(const VectorXd& old, const VectorXd& angles, const VectorXd& weights, double farthest)
{
    VectorXd target = centered_angles(angles, weights, old);
    const Eigen::Index m = old.size();
    VectorXd change = target - old;
    change.array() -= 2.0 * pi * std::round(change.mean() / (2.0 * pi));
    const auto step = [m](const VectorXd& a, Eigen::Index b) {
        return b + 1 < m ? a[b + 1] - a[b] : a[0] + 2.0 * pi - a[m - 1];
    };
    for (const double share : {1.0, 0.75, 0.6}) {
        const double far = share * farthest;
        VectorXd result = old + far * change;
        bool in_order = true;
        for (Eigen::Index b = 0; b < m; ++b)
            in_order &= step(result, b) > 0.2 * std::min(step(old, b), step(target, b));
        if (in_order) return centered_angles(result, weights, old);
    }
    return target;
}

/// The conformal map to C / (Z + tau Z), |Re tau| <= 1/2 and |tau| >= 1, holes on circles.
///
/// A round disk of closed form fills every hole, given by one angle for each vertex of the loop, as in the condensed
/// engine (docs/method.md). The filled surface is a closed torus: two harmonic 1-forms with the periods (1, 0) and (0,
/// 1) and the energies E give tau = (-E_12 + i sqrt(det E)) / E_22 and the map. With the right angles the image of a
/// loop is a circle. The fixed point theta <- arg(z - c) halves the error of a single hole, so a sweep goes twice as
/// far: theta <- 2 arg(z - c) - theta. To first order only the interaction of the holes and their copies is left.
///
/// @param domain of periodic_torus; its shifts are replaced by those of the reduced periods
/// @return the loops on their circles, if the circles are apart; periods 1 and tau
/// @throws SolverError, Cancelled
FlatMap torus_circles(PeriodicSurface& domain, const IterationOptions& options, ExecutionContext& context)
{
    FilledTorus torus(domain);
    const std::size_t holes = domain.loops.size();
    std::vector<VectorXd> weights, angles;
    for (const VectorXd& edges : domain.edges) {
        weights.push_back(vertex_weights(edges));
        angles.push_back(centered_angles(arc_length_angles(edges), weights.back()));
    }
    FlatMap map;
    CircleState state;
    state.circles.assign(holes, {0.0, 0.0});
    double farthest = 2.0;  // factor on the change of the angles
    MatrixXd u;
    Complex tau;
    std::vector<VectorXcd> images(holes);
    map.converged = holes == 0;
    for (int sweep = 0; sweep <= options.max_sweeps; ++sweep) {
        context.advance(static_cast<double>(sweep) / (sweep + 4.0));
        torus.set_disks(angles);
        u = torus.solve();
        tau = modulus(torus.energies(u));
        if (sweep == 0) {
            tau = reduce(tau, domain, u);
            torus.take_loads();
        }
        const VectorXcd z = u.col(0) + tau * u.col(1);
        for (std::size_t k = 0; k < holes; ++k) images[k] = gather_loop(z, domain.loops[k]);
        CircleState next = circle_state(images);
        if (sweep > 0) {
            map.changes.push_back(circle_change(state, next));
            map.converged = map.changes.back() < options.tolerance;
            if (sweep > 1 && !(map.changes.back() < 0.7 * map.changes[map.changes.size() - 2]))
                farthest = std::max(0.8, 0.8 * farthest);  // holes that nearly meet make each other swing
        }
        state = std::move(next);
        if (map.converged) break;
        for (std::size_t k = 0; k < holes; ++k)
            angles[k] = relaxed(angles[k], angles_of(images[k], state.circles[k]), weights[k], farthest);
    }
    const Complex before = tau;
    MatrixXd reduced = u;
    tau = reduce(tau, domain, reduced);
    map.z = reduced.col(0) + tau * reduced.col(1);
    map.periods = {1.0, tau};
    if (tau != before) {
        for (std::size_t k = 0; k < holes; ++k) images[k] = gather_loop(map.z, domain.loops[k]);
        state = circle_state(images);
    }
    map.circles = state.circles;
    map.apart = apart_in_tile(map.circles, {1.0, tau});
    VectorXcd places = map.z;
    std::vector<char> moved(static_cast<std::size_t>(map.z.size()), 0);
    for (std::size_t k = 0; k < holes; ++k) {
        map.roundness.push_back(roundness(images[k], map.circles[k]));
        const VectorXcd points = project_onto_circle(map.circles[k], images[k], -1);
        for (std::size_t b = 0; b < domain.loops[k].size(); ++b) {
            places[domain.loops[k][b]] = points[static_cast<Eigen::Index>(b)];
            moved[domain.loops[k][b]] = 1;
        }
    }
    if (map.apart && holes > 0) move_boundary(domain, places, moved, map.z);
    return map;
}

TileResult torus_map_here(const Vertices& vertices, const Triangles& triangles, const TileOptions& options,
                          ExecutionContext& context)
{
    fix_product_blocks();
    MapClock clock;
    context.begin_stage("topology", 0.0, 0.1);
    PeriodicSurface domain = periodic_torus(vertices, triangles);
    domain.polygon = options.polygon;
    clock.end(&StageSeconds::topology);
    context.begin_stage("iterate", 0.1, 0.9);
    IterationOptions iteration;
    static_cast<SweepOptions&>(iteration) = options;
    FlatMap map = torus_circles(domain, iteration, context);
    clock.end(&StageSeconds::iterate);
    context.begin_stage("finish", 0.9, 1.0);
    TileResult result = tile_result(vertices, triangles, domain, options, HoleShape::open, map, context);
    result.modulus = map.periods[1] / map.periods[0];
    take_verdict({.most_lost = options.most_lost}, result);
    clock.finish(result, context);
    return result;
}

}  // namespace

TileResult torus_map(const Vertices& vertices, const Triangles& triangles, const TileOptions& options,
                     ExecutionContext& context)
{
    return canonical_tile(vertices, triangles, options, context, torus_map_here);
}

}  // namespace koebe
