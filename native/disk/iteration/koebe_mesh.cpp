#include "iteration/koebe_mesh.h"

#include "circles/boundary_angles.h"
#include "circles/circle_fit.h"
#include "conformal/disk_map.h"
#include "core/connectivity.h"
#include "core/errors.h"
#include "iteration/convergence.h"
#include "iteration/disk_patch.h"
#include "surface/deepest_vertex.h"
#include "surface/harmonic_map.h"
#include "surface/loop_edges.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace koebe {
namespace {

constexpr double shortest_step = 1e-4;  // of the mean step of the angles along a loop

/// S with some of its disks, in one numbering: the surface's vertices first, then those inside the disks.
struct FilledMesh {
    Triangles triangles;
    EdgeLengths lengths;
    Index vertex_count = 0;
    std::vector<Index> offset;  // per disk: added to the numbers of its inner vertices; -1 if the disk is removed
};

/// The vertex deepest inside the surface, with all loops as boundary; -1 without inner vertices.
Index deepest_inside(const Triangles& triangles, const EdgeLengths& lengths, Index vertex_count,
                     const std::vector<VertexLoop>& loops)
{
    std::vector<char> outer = unused_vertices(triangles, vertex_count);
    for (const VertexLoop& loop : loops)
        for (const Index v : loop) outer[v] = 1;
    return deepest_vertex(triangles, lengths, outer);
}

/// The reflection tau in the unit circle around a point, with that point moved to 0: z -> 1 / conj(z - center).
struct Reflection {
    Complex center;

    Complex operator()(Complex z) const { return 1.0 / std::conj(z - center); }
    VectorXcd operator()(const VectorXcd& z) const
    {
        return z.unaryExpr([this](Complex point) { return (*this)(point); });
    }
    Circle operator()(const Circle& circle) const
    {
        const Complex from = circle.center - center;
        const double power = std::norm(from) - circle.radius * circle.radius;
        return {from / power, circle.radius / std::abs(power)};
    }
};

bool reflects(KoebeMeshOptions::Metric metric)
{
    return metric == KoebeMeshOptions::Metric::reflected || metric == KoebeMeshOptions::Metric::reflected_last;
}

/// The first loop of the next step that is filled in this step; -1 if there is no such loop.
int opened_newly(const OpenedLoops& now, const OpenedLoops& next)
{
    const auto found = std::ranges::find_if(next, [&](int k) { return std::ranges::find(now, k) == now.end(); });
    return found == next.end() ? -1 : *found;
}

/// The picture that a step draws: positions of the vertices that it maps, and circles of the loops that it opens.
struct StepImage {
    VectorXcd positions;
    std::vector<Circle> circles;
};

class MeshKoebe {
public:
    MeshKoebe(const Vertices& vertices, const Triangles& triangles, const EdgeLengths& lengths,
              const std::vector<VertexLoop>& loops, const KoebeMeshOptions& options)
        : metric_(options.metric),
          annulus_(options.annulus),
          loops_(loops),
          triangles_(triangles),
          lengths_(lengths),
          vertex_count_(static_cast<Index>(vertices.rows())),
          radius_(loops.size(), 1.0),
          stale_(loops.size(), 0)
    {
        for (const VertexLoop& loop : loops) {
            const VectorXd edges = loop_edges(vertices, loop);
            weights_.push_back(vertex_weights(edges));
            angles_.push_back(centered_angles(arc_length_angles(edges), weights_.back()));
            patches_.emplace_back(vertices(loop, Eigen::all));
        }
    }

    /// Takes one step: removes the disks of the open loops, maps the rest with the first of these loops on the unit
    /// circle, fills their circles. @param next the loops that the next step opens @return the image of S, (V)
    VectorXcd step(const OpenedLoops& open, const OpenedLoops& next)
    {
        const FilledMesh mesh = assemble(open);
        StepImage image = open.size() == 1 ? riemann_image(mesh, open[0]) : annulus_image(mesh, open[0], open[1]);
        VectorXcd of_surface = image.positions.head(vertex_count_);
        int holds_center = -1;  // the disk around the reflection's centre; -1: the centre is in the hole opened last
        if (reflects(metric_)) {
            if (metric_ == KoebeMeshOptions::Metric::reflected) holds_center = opened_newly(open, next);
            if (holds_center >= 0 || open.size() > 1) {  // else the one loop is opened again: no disk reaches infinity
                const Reflection tau{holds_center < 0 ? Complex{} : point_inside(mesh, image.positions, holds_center)};
                image.positions = tau(image.positions);
                for (Circle& circle : image.circles) circle = tau(circle);
            }
        }
        if (metric_ != KoebeMeshOptions::Metric::first) take_planar_metric(mesh, image.positions, holds_center);
        for (std::size_t s = 0; s < open.size(); ++s) {
            const Circle& circle = image.circles[s];
            set_angles(open[s], gather_loop(image.positions, loops_[open[s]]).array() - circle.center);
            radius_[open[s]] = circle.radius;
            stale_[open[s]] = 1;
        }
        return of_surface;
    }

    /// Number of angle steps raised since the last call.
    int take_raised() { return std::exchange(raised_, 0); }

    /// The step with one loop, which leaves no disk to fill.
    void open_disk()
    {
        const DiskMap map = disk_map(triangles_, lengths_, vertex_count_, loops_[0], {.inside = false});
        set_angles(0, gather_loop(map.positions, loops_[0]));
    }

    /// The map of S and D_1, ..., D_n to the unit disk, on the surface's vertices.
    VectorXcd disk_image()
    {
        const FilledMesh mesh = assemble({0});
        return harmonic_map(mesh.triangles, mesh.lengths, mesh.vertex_count, loops_[0], unit_circle_points(angles_[0]))
            .head(vertex_count_);
    }

private:
    StepImage riemann_image(const FilledMesh& mesh, int k)
    {
        if (!center_) center_ = deepest_inside(triangles_, lengths_, vertex_count_, loops_);
        return {disk_map(mesh.triangles, mesh.lengths, mesh.vertex_count, loops_[k],
                         {.center = *center_, .inside = false, .backend = annulus_})
                    .positions,
                {Circle{}}};
    }

    StepImage annulus_image(const FilledMesh& mesh, int i, int j) const
    {
        const AnnulusMap map = annulus_map(mesh.triangles, mesh.lengths, mesh.vertex_count, loops_[i], loops_[j],
                                           {.backend = annulus_, .inside = false});
        if (!map.converged) throw SolverError("the discrete Yamabe flow of a step's annulus did not converge");
        return {map.positions, {Circle{}, Circle{0.0, map.inner_radius}}};
    }

    /// The surface with all disks except the removed ones. Fills disks again whose rim has moved.
    FilledMesh assemble(const std::vector<int>& removed)
    {
        FilledMesh mesh{triangles_, lengths_, vertex_count_, std::vector<Index>(loops_.size(), -1)};
        Eigen::Index row = triangles_.rows(), face_count = row;
        for (std::size_t k = 0; k < loops_.size(); ++k)
            if (std::find(removed.begin(), removed.end(), static_cast<int>(k)) == removed.end()) {
                // The reflection in a circle brings in the disk outside it, and keeps the rim. So each rim bounds a
                // disk, and runs clockwise where its angles are counter-clockwise.
                if (std::exchange(stale_[k], 0))
                    patches_[k].refill(unit_circle_points(angles_[k]).conjugate(), radius_[k]);
                mesh.offset[k] = mesh.vertex_count - patches_[k].rim_size();
                mesh.vertex_count += patches_[k].vertex_count() - patches_[k].rim_size();
                face_count += patches_[k].triangles().rows();
            }
        mesh.triangles.conservativeResize(face_count, 3);
        mesh.lengths.conservativeResize(face_count, 3);
        for (std::size_t k = 0; k < loops_.size(); ++k) {
            if (mesh.offset[k] < 0) continue;
            const Triangles& own = patches_[k].triangles();
            mesh.lengths.middleRows(row, own.rows()) = patches_[k].lengths();
            for (Eigen::Index f = 0; f < own.rows(); ++f, ++row)
                for (int c = 0; c < 3; ++c)
                    mesh.triangles(row, c) =
                        own(f, c) < patches_[k].rim_size() ? loops_[k][own(f, c)] : mesh.offset[k] + own(f, c);
        }
        return mesh;
    }

    /// The point of a disk's image that is farthest from its rim, among the vertices inside the disk.
    Complex point_inside(const FilledMesh& mesh, const VectorXcd& z, int disk) const
    {
        const VectorXcd rim = gather_loop(z, loops_[disk]);
        Complex deepest = rim.mean();  // of a disk without such a vertex
        double depth = 0.0;
        for (Index v = patches_[disk].rim_size(); v < patches_[disk].vertex_count(); ++v) {
            const Complex point = z[mesh.offset[disk] + v];
            const double distance = (rim.array() - point).abs().minCoeff();
            if (distance <= depth) continue;
            depth = distance;
            deepest = point;
        }
        return deepest;
    }

    /// @param holds_center this disk, which holds the reflection's centre, keeps its metric: its image is unbounded;
    /// the next step removes it. -1: no disk
    void take_planar_metric(const FilledMesh& mesh, const VectorXcd& z, int holds_center)
    {
        const EdgeLengths lengths = planar_lengths(z, mesh.triangles);
        Eigen::Index row = triangles_.rows();
        lengths_ = lengths.topRows(row);
        for (std::size_t k = 0; k < loops_.size(); ++k) {
            if (mesh.offset[k] < 0) continue;
            const Eigen::Index count = patches_[k].triangles().rows();
            if (static_cast<int>(k) != holds_center) patches_[k].set_lengths(lengths.middleRows(row, count));
            row += count;
        }
    }

    /// Sets the angles at which a loop runs round 0, counter-clockwise. A clockwise loop is mirrored first. Steps that
    /// do not go forward are raised to small ones.
    void set_angles(int k, const VectorXcd& circle)
    {
        const Eigen::Index m = circle.size();
        VectorXd step(m);
        const double least = shortest_step * 2.0 * std::numbers::pi / static_cast<double>(m);
        for (Eigen::Index b = 0; b < m; ++b) step[b] = std::arg(circle[(b + 1) % m] / circle[b]);
        const double sense = step.sum() < 0.0 ? -1.0 : 1.0;
        step *= sense;
        for (Eigen::Index b = 0; b < m; ++b) {
            if (!(step[b] > least)) {
                step[b] = least;
                ++raised_;
            }
        }
        const VectorXd angles = arc_length_angles(step).array() + sense * std::arg(circle[0]);
        angles_[k] =
            metric_ == KoebeMeshOptions::Metric::first ? centered_angles(angles, weights_[k], angles_[k]) : angles;
    }

    KoebeMeshOptions::Metric metric_;
    AnnulusBackend annulus_;
    const std::vector<VertexLoop>& loops_;
    const Triangles& triangles_;
    EdgeLengths lengths_;
    Index vertex_count_;
    std::optional<Index> center_;    // p of the Riemann map (section 4.3), once a step has chosen it
    std::vector<VectorXd> weights_;  // per loop: share of each vertex in its length
    std::vector<VectorXd> angles_;   // per loop: angles of its vertices on the rim of D_k, counter-clockwise
    std::vector<double> radius_;     // per loop: radius of D_k, in the unit of the surface's lengths
    std::vector<DiskPatch> patches_;
    int raised_ = 0;
    std::vector<char> stale_;  // per loop: whether its disk must be filled again, as the angles have changed
};

/// The images of the loops.
std::vector<VectorXcd> gather_loops(const VectorXcd& positions, const std::vector<VertexLoop>& loops)
{
    std::vector<VectorXcd> images;
    for (const VertexLoop& loop : loops) images.push_back(gather_loop(positions, loop));
    return images;
}

}  // namespace

void require_possible(const KoebeMeshOptions& mesh_options, int loop_count, Method method)
{
    if (!mesh_options.schedule.empty()) require_schedule(mesh_options.schedule, loop_count, method);
    if (mesh_options.partners == Partners::changing && (method != Method::gk || !mesh_options.schedule.empty()))
        throw InputError("changing partners need the generalized method and no schedule");
    if (mesh_options.metric == KoebeMeshOptions::Metric::reflected_last && method == Method::ck)
        throw InputError("the conventional method leaves no hole opened last to reflect in");
    if (mesh_options.annulus == AnnulusBackend::yamabe && mesh_options.metric == KoebeMeshOptions::Metric::first)
        throw InputError("the Yamabe flow needs a planar or reflected metric: the same on surface and disks");
}

KoebeMeshResult koebe_mesh(const Vertices& vertices, const Triangles& triangles, const EdgeLengths& lengths,
                           const std::vector<VertexLoop>& loops, const IterationOptions& options,
                           ExecutionContext& context, const KoebeMeshOptions& mesh_options)
{
    KoebeMeshResult result;
    KoebeOutcome& outcome = result.outcome;
    const int loop_count = static_cast<int>(loops.size());
    require_possible(mesh_options, loop_count, options.method);
    MeshKoebe state(vertices, triangles, lengths, loops, mesh_options);
    // One loop: the Riemann map (section 4.3) is exact.
    if (loops.size() == 1) {
        state.open_disk();
        result.positions = state.disk_image();
        outcome.loops = {gather_loop(result.positions, loops[0])};
        outcome.converged = true;
        return result;
    }
    // The steps: a schedule, pairs that change from sweep to sweep (Fig. 4), or the same pairs in each sweep.
    const std::vector<Sweep> round = !mesh_options.schedule.empty() ? std::vector<Sweep>{mesh_options.schedule}
                                     : mesh_options.partners == Partners::changing
                                         ? round_of_changing_pairs(loop_count)
                                         : std::vector<Sweep>{fixed_sweep(loop_count, options.method)};
    CircleState now, at_round_start;
    std::vector<double> changes;  // of each round
    while (!outcome.converged && outcome.sweeps < options.max_sweeps) {
        const Sweep& sweep = round[outcome.sweeps % round.size()];
        if (&sweep == &round.front()) at_round_start = now;
        const Sweep& next_sweep = round[(outcome.sweeps + 1) % round.size()];
        for (std::size_t s = 0; s < sweep.size(); ++s) {
            context.advance(1.0 - std::pow(0.5, outcome.sweeps + static_cast<double>(s) / sweep.size()));
            // Section 4.4: open the loops of the step, map to a disk or an annulus, fill the holes again. The metric
            // may be reflected in a circle inside a hole that the next step opens.
            VectorXcd image = state.step(sweep[s], s + 1 < sweep.size() ? sweep[s + 1] : next_sweep.front());
            if (mesh_options.record_steps) outcome.step_images.push_back(std::move(image));
            context.checkpoint();
            result.positions = state.disk_image();
            outcome.loops = gather_loops(result.positions, loops);
            // Section 4.4, the test: sum of |c_k - c_k'|^2 + |r_k - r_k'|^2, over a whole round.
            CircleState next = circle_state(outcome.loops);
            outcome.history.push_back({++outcome.steps,
                                       {sweep[s].front(), sweep[s].back()},
                                       circle_change(now, next),
                                       next.mean_roundness,
                                       next.circles});
            now = std::move(next);
        }
        ++outcome.sweeps;
        outcome.raised_angles = state.take_raised();
        if (&sweep != &round.back()) continue;
        outcome.converged = has_converged(at_round_start, now, options.tolerance);
        changes.push_back(circle_change(at_round_start, now));
        if (is_at_standstill(changes)) break;
    }
    return result;
}

KoebeMeshResult koebe_mesh(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
                           const IterationOptions& options, ExecutionContext& context,
                           const KoebeMeshOptions& mesh_options)
{
    return koebe_mesh(vertices, surface.triangles, edge_lengths(vertices, surface.triangles), loops, options, context,
                      mesh_options);
}

}  // namespace koebe
