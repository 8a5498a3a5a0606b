#include "iteration/koebe_mesh.h"

#include "circles/boundary_angles.h"
#include "circles/circle_fit.h"
#include "conformal/annulus_map.h"
#include "conformal/disk_map.h"
#include "iteration/convergence.h"
#include "iteration/sweep_order.h"
#include "surface/harmonic_map.h"
#include "surface/loop_edges.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace koebe {
namespace {

constexpr double shortest_step = 1e-4;  // of the mean step of the angles along a loop

/// S with some of its disks, in one numbering: the surface's vertices first, then those inside the disks.
struct FilledMesh {
    Triangles triangles;
    EdgeLengths lengths;
    Index vertex_count = 0;
    std::vector<Index> offset;  // per disk: what its inner vertices' numbers are raised by; -1 if it is removed
};

class MeshKoebe {
public:
    MeshKoebe(const Vertices& vertices, const Triangles& triangles, const EdgeLengths& lengths,
              const std::vector<VertexLoop>& loops, const KoebeMeshOptions& options)
        : metric_(options.metric),
          loops_(loops),
          triangles_(triangles),
          lengths_(lengths),
          vertex_count_(static_cast<Index>(vertices.rows())),
          stale_(loops.size(), 0)
    {
        for (const VertexLoop& loop : loops) {
            const VectorXd edges = loop_edges(vertices, loop);
            weights_.push_back(vertex_weights(edges));
            angles_.push_back(centered_angles(arc_length_angles(edges), weights_.back()));
            patches_.emplace_back(vertices(loop, Eigen::all), options.patch);
        }
    }

    /// One step: disks i and j removed, the rest mapped to an annulus with loop i outside, its circles filled.
    void open_pair(int i, int j)
    {
        const FilledMesh mesh = assemble({i, j});
        const AnnulusMap map =
            annulus_map(mesh.triangles, mesh.lengths, mesh.vertex_count, loops_[i], loops_[j], {.inside = false});
        if (metric_ == KoebeMeshOptions::Metric::present) take_planar_metric(mesh, map.positions);
        // D_i lies outside the unit circle: tau(z) = 1 / conj(z) brings it in, and conjugation turns it back to the
        // orientation of the surface. So both rims are conj(z / |z|) on a circle run through clockwise.
        set_angles(i, gather_loop(map.positions, loops_[i]));
        set_angles(j, gather_loop(map.positions, loops_[j]).conjugate());
        stale_[i] = stale_[j] = 1;
    }

    /// Steps of angles raised since the last call.
    int take_raised() { return std::exchange(raised_, 0); }

    /// With one loop: no disk is left to fill.
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
    /// The surface with all disks but those, the ones whose rim has moved filled again.
    FilledMesh assemble(const std::vector<int>& removed)
    {
        FilledMesh mesh{triangles_, lengths_, vertex_count_, std::vector<Index>(loops_.size(), -1)};
        Eigen::Index row = triangles_.rows(), face_count = row;
        for (std::size_t k = 0; k < loops_.size(); ++k)
            if (std::find(removed.begin(), removed.end(), static_cast<int>(k)) == removed.end()) {
                if (std::exchange(stale_[k], 0)) patches_[k].refill(unit_circle_points(angles_[k]).conjugate());
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

    void take_planar_metric(const FilledMesh& mesh, const VectorXcd& z)
    {
        const EdgeLengths lengths = planar_lengths(z, mesh.triangles);
        Eigen::Index row = triangles_.rows();
        lengths_ = lengths.topRows(row);
        for (std::size_t k = 0; k < loops_.size(); ++k) {
            if (mesh.offset[k] < 0) continue;
            const Eigen::Index count = patches_[k].triangles().rows();
            patches_[k].set_lengths(lengths.middleRows(row, count));
            row += count;
        }
    }

    /// The angles at which a loop runs counter-clockwise round 0, steps that are no steps forward raised to small ones.
    void set_angles(int k, const VectorXcd& circle)
    {
        const Eigen::Index m = circle.size();
        VectorXd step(m);
        const double least = shortest_step * 2.0 * std::numbers::pi / static_cast<double>(m);
        for (Eigen::Index b = 0; b < m; ++b) {
            step[b] = std::arg(circle[(b + 1) % m] / circle[b]);
            if (!(step[b] > least)) {
                step[b] = least;
                ++raised_;
            }
        }
        angles_[k] = centered_angles(arc_length_angles(step), weights_[k], angles_[k]);
    }

    KoebeMeshOptions::Metric metric_;
    const std::vector<VertexLoop>& loops_;
    const Triangles& triangles_;
    EdgeLengths lengths_;
    Index vertex_count_;
    std::vector<VectorXd> weights_;  // per loop: share of each vertex in its length
    std::vector<VectorXd> angles_;   // per loop: where its vertices are on the rim of D_k, counter-clockwise
    std::vector<DiskPatch> patches_;
    int raised_ = 0;
    std::vector<char> stale_;  // per loop: its disk has not been filled since the angles changed
};

/// The images of the loops.
std::vector<VectorXcd> gather_loops(const VectorXcd& positions, const std::vector<VertexLoop>& loops)
{
    std::vector<VectorXcd> images;
    for (const VertexLoop& loop : loops) images.push_back(gather_loop(positions, loop));
    return images;
}

}  // namespace

KoebeMeshResult koebe_mesh(const Vertices& vertices, const Triangles& triangles, const EdgeLengths& lengths,
                           const std::vector<VertexLoop>& loops, const IterationOptions& options,
                           ExecutionContext& context, const KoebeMeshOptions& mesh_options)
{
    KoebeMeshResult result;
    KoebeOutcome& outcome = result.outcome;
    MeshKoebe state(vertices, triangles, lengths, loops, mesh_options);
    if (loops.size() == 1) {
        state.open_disk();
        result.positions = state.disk_image();
        outcome.loops = {gather_loop(result.positions, loops[0])};
        outcome.converged = true;
        return result;
    }
    const auto pairs = sweep_pairs(static_cast<int>(loops.size()), options.method);
    CircleState now;
    while (!outcome.converged && outcome.sweeps < options.max_sweeps) {
        const CircleState at_sweep_start = now;
        for (std::size_t p = 0; p < pairs.size(); ++p) {
            context.advance(1.0 - std::pow(0.5, outcome.sweeps + static_cast<double>(p) / pairs.size()));
            state.open_pair(pairs[p].first, pairs[p].second);
            context.checkpoint();
            result.positions = state.disk_image();
            outcome.loops = gather_loops(result.positions, loops);
            CircleState next = circle_state(outcome.loops, fit_circle_paper);
            outcome.history.push_back(
                {++outcome.steps, pairs[p], circle_change(now, next), next.mean_roundness, next.circles});
            now = std::move(next);
        }
        ++outcome.sweeps;
        outcome.raised_angles = state.take_raised();
        outcome.converged = has_converged(at_sweep_start, now, options.tolerance);
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
