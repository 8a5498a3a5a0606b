#include "flow/yamabe_flow.h"

#include "core/connectivity.h"
#include "core/errors.h"
#include "flow/curvature.h"
#include "surface/edge_flip.h"

#include <cmath>

namespace koebe {
namespace {

constexpr double delaunay_tolerance = 1e-10;  // on the sum of the two cosines, dimensionless

std::vector<char> ends_of_boundary_edges(const Triangles& triangles, const std::vector<Index>& twin, Index vertex_count)
{
    std::vector<char> boundary(vertex_count, 0);
    for (Index h = 0; h < static_cast<Index>(twin.size()); ++h)
        if (twin[h] == no_twin) boundary[origin(triangles, h)] = boundary[target(triangles, h)] = 1;
    return boundary;
}

}  // namespace

YamabeEnergy::YamabeEnergy(const Triangles& triangles, const EdgeLengths& lengths, const VectorXd& target, bool flips)
    : triangles_(triangles),
      lengths_(lengths),
      scaled_(lengths),
      twin_(pair_halfedges(triangles, static_cast<Index>(target.size()))),
      boundary_(ends_of_boundary_edges(triangles, twin_, static_cast<Index>(target.size()))),
      target_(target),
      flipping_(flips)
{
    const double sum = discrete_curvature(triangles, lengths, boundary_).sum();
    if (!(std::abs(target.sum() - sum) < 1e-6))
        throw InputError("the target curvature sums to " + std::to_string(target.sum()) +
                         ", not to 2 pi chi = " + std::to_string(sum));
}

double YamabeEnergy::scaled_length(Index h, const VectorXd& u) const
{
    return lengths_.data()[h] * std::exp(0.5 * (u[origin(triangles_, h)] + u[koebe::target(triangles_, h)]));
}

/// Cosine of the angle opposite to half-edge h; beyond 1 in absolute value where the triangle inequality fails.
double YamabeEnergy::cosine(Index h, const VectorXd& u) const
{
    const double a = scaled_length(h, u);
    const double b = scaled_length(next_halfedge(h), u), c = scaled_length(previous_halfedge(h), u);
    return (b * b + c * c - a * a) / (2.0 * b * c);
}

void YamabeEnergy::make_delaunay(const VectorXd& u)
{
    std::vector<Index> stack;
    for (Index h = 0; h < static_cast<Index>(twin_.size()); ++h)
        if (twin_[h] > h) stack.push_back(h);
    // Lawson's algorithm ends; the bound guards against round-off on cocircular quadrilaterals.
    long left = 20L * static_cast<long>(twin_.size()) + 1000;
    while (!stack.empty() && left-- > 0) {
        const Index h = stack.back();
        stack.pop_back();
        const Index t = twin_[h];
        if (t == no_twin || face_of(t) == face_of(h)) continue;
        if (!(cosine(h, u) + cosine(t, u) < -delaunay_tolerance)) continue;
        const Index c = origin(triangles_, previous_halfedge(h)), d = origin(triangles_, previous_halfedge(t));
        if (c == d) continue;
        const auto length = [&](Index e) { return lengths_.data()[e]; };
        const double diagonal = (length(next_halfedge(h)) * length(next_halfedge(t)) +
                                 length(previous_halfedge(h)) * length(previous_halfedge(t))) /
                                length(h);
        flip_edge(triangles_, lengths_, twin_, h, diagonal);
        ++flips_;
        for (const Index face : {face_of(h), face_of(t)})
            for (Index e = 3 * face; e < 3 * face + 3; ++e)
                if (twin_[e] != no_twin) stack.push_back(e);
    }
}

VectorXd YamabeEnergy::gradient(const VectorXd& u)
{
    if (flipping_) make_delaunay(u);
    for (Index h = 0; h < static_cast<Index>(twin_.size()); ++h) scaled_.data()[h] = scaled_length(h, u);
    return discrete_curvature(triangles_, scaled_, boundary_) - target_;
}

SparseMatrix YamabeEnergy::hessian() const
{
    EdgeLengths weights = half_cotangents(scaled_);
    // The angles of a collapsed face do not change.
    for (Eigen::Index f = 0; f < weights.rows(); ++f)
        if (!(triangle_area(scaled_(f, 0), scaled_(f, 1), scaled_(f, 2)) > 0.0)) weights.row(f).setZero();
    return cotan_laplacian(triangles_, weights, static_cast<Index>(target_.size()));
}

YamabeResult yamabe_flow(const Triangles& triangles, const EdgeLengths& lengths, const VectorXd& target,
                         const YamabeOptions& options, ExecutionContext& context)
{
    YamabeEnergy energy(triangles, lengths, target, options.flips);
    YamabeResult result;
    result.u = VectorXd::Zero(target.size());
    result.newton = ConvexNewton().minimize(energy, result.u, options.newton, context);
    energy.gradient(result.u);
    result.triangles = energy.triangles();
    result.lengths = energy.scaled_lengths();
    result.twin = energy.twin();
    result.flips = energy.flips();
    result.collapsed = collapsed_faces(result.lengths);
    result.converged = result.newton.converged && result.collapsed.empty();
    return result;
}

}  // namespace koebe
