#include "schottky/glued_state.h"

#include "circles/boundary_angles.h"
#include "core/errors.h"
#include "execution/memory_limit.h"
#include "iteration/disk_dirichlet_to_neumann.h"
#include "linear/dense_spd.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace koebe {
namespace {

using std::numbers::pi;

constexpr double dense_matrices = 5.0;  // Sigma, A, its factor, the factor's inverse, and a temporary

/// Half the arcs to both neighbours: the part of the circle that belongs to each node.
VectorXd arcs_around(const VectorXd& angles)
{
    const Eigen::Index n = angles.size();
    VectorXd result(n);
    for (Eigen::Index b = 0; b < n; ++b) {
        const double before = b > 0 ? angles[b - 1] : angles[n - 1] - 2.0 * pi;
        const double after = b + 1 < n ? angles[b + 1] : angles[0] + 2.0 * pi;
        result[b] = 0.5 * (after - before);
    }
    return result;
}

}  // namespace

GluedState::GluedState(const CondensedLaplacian& surface, const std::vector<CutLoop>& loops)
    : loops_(loops), sigma_(surface.sigma()), filled_(sigma_)
{
    require_memory(dense_matrices * 8.0 * std::pow(surface.boundary_size(), 2), "the boundary's dense matrices");
    Eigen::Index begin = 0;
    for (const CutLoop& loop : loops) {
        begin_.push_back(begin);
        begin += loop.edges.size();
        weights_.push_back(vertex_weights(loop.edges));
        angles_.push_back(centered_angles(arc_length_angles(loop.edges), weights_.back()));
        disks_.emplace_back();
    }
    for (std::size_t k = 0; k < loops.size(); ++k) fill(k, angles_[k]);
}

double GluedState::sweep()
{
    const Eigen::Index n = filled_.rows();
    // For loads of sum 0, A + alpha 1 1' with any alpha has the solutions of A with mean 0.
    const double alpha = filled_.trace() / static_cast<double>(n) / static_cast<double>(n);
    const MatrixXd factor = spd_factor((filled_.array() + alpha).matrix());
    const MatrixXd inverse_factor = lower_inverse(factor);
    std::vector<VectorXd> next(loops_.size());
    for (std::size_t k = 0; k < loops_.size(); ++k) {
        const VectorXd flux = flux_through(k, inverse_factor);
        int raised = 0;
        const VectorXd angles = angles_from_flux(flux, loops_[k].edges, raised);
        const auto other = static_cast<std::size_t>(loops_[k].partner);
        next[other] = other == k ? angles : seen_from_the_other_side(other, angles);
    }
    double change = 0.0;
    for (std::size_t k = 0; k < loops_.size(); ++k) {
        const MatrixXd before = std::move(disks_[k]);
        fill(k, centered_angles(next[k], weights_[k], angles_[k]));
        change = std::max(change, (disks_[k] - before).norm() / before.norm());
    }
    return change;
}

VectorXcd GluedState::rim() const { return unit_circle_points(angles_[0]); }

std::vector<VectorXcd> GluedState::images_in_disk(const VectorXcd& rim) const
{
    const Eigen::Index outer = rim.size(), rest = filled_.rows() - outer;
    MatrixXd parts(outer, 2);
    parts << rim.real(), rim.imag();
    MatrixXd z(filled_.rows(), 2);
    z << parts, spd_solve(filled_.bottomRightCorner(rest, rest), -(filled_.bottomLeftCorner(rest, outer) * parts));
    return split(z);
}

/// Puts infinity in the middle of the first loop's disk. There w = exp(-i theta), as the loop runs clockwise round its
/// hole, and z - 1 / w is regular. In the disk 1 / w - conj(w) is 0 on the circle and has the normal derivative -2
/// exp(i theta) there, which is the load.
std::vector<VectorXcd> GluedState::images_round_infinity() const
{
    const Eigen::Index n = filled_.rows();
    MatrixXd load = MatrixXd::Zero(n, 2);
    const VectorXd& angles = angles_[0];
    for (Eigen::Index b = 0; b < angles.size(); ++b) {
        // Integrals over an arc of exp(i theta) times the hat functions of its ends. Their sum must be 0 to the last
        // bits: any remainder would run to the farthest loops, where the map hardly changes.
        const Eigen::Index after = (b + 1) % angles.size();
        const double arc = angles[after] - angles[b] + (after == 0 ? 2.0 * pi : 0.0);
        const Complex begin = std::polar(1.0, angles[b]), end = begin * std::polar(1.0, arc);
        const Complex chord = (end - begin) / arc;
        const Complex i(0.0, 1.0);
        const Complex at_begin = 2.0 * (i * begin - chord), at_end = 2.0 * (chord - i * end);
        load.row(b) += Eigen::RowVector2d(at_begin.real(), at_begin.imag());
        load.row(after) += Eigen::RowVector2d(at_end.real(), at_end.imag());
    }
    const double alpha = filled_.trace() / static_cast<double>(n) / static_cast<double>(n);
    return split(spd_solve((filled_.array() + alpha).matrix(), load));
}

std::vector<Complex> GluedState::shifts_without_flux(const std::vector<VectorXcd>& images) const
{
    const auto count = static_cast<Eigen::Index>(images.size());
    MatrixXd boundary(sigma_.rows(), 2), ones = MatrixXd::Zero(sigma_.rows(), count);
    for (Eigen::Index k = 0; k < count; ++k) {
        const VectorXcd& image = images[static_cast<std::size_t>(k)];
        const Eigen::Index begin = begin_[static_cast<std::size_t>(k)];
        boundary.middleRows(begin, image.size()) << image.real(), image.imag();
        ones.col(k).segment(begin, image.size()).setOnes();
    }
    const MatrixXd capacities = ones.transpose() * (sigma_ * ones);
    const MatrixXd flux = ones.transpose() * (sigma_ * boundary);
    std::vector<Complex> shifts(images.size(), 0.0);
    const Eigen::Index rest = count - 1;
    const MatrixXd solved = spd_solve(capacities.bottomRightCorner(rest, rest), -flux.bottomRows(rest));
    for (Eigen::Index k = 0; k < rest; ++k) shifts[static_cast<std::size_t>(k) + 1] = {solved(k, 0), solved(k, 1)};
    return shifts;
}

void GluedState::fill(std::size_t k, VectorXd angles)
{
    angles_[k] = std::move(angles);
    disks_[k] = disk_dirichlet_to_neumann(angles_[k]);
    const Eigen::Index at = begin_[k], n = angles_[k].size();
    filled_.block(at, at, n, n) = sigma_.block(at, at, n, n) + disks_[k];
}

/// The flux with loop k at 0, from a source of 1 in the middle of the disk in the other side, or in the next loop.
VectorXd GluedState::flux_through(std::size_t k, const MatrixXd& inverse_factor) const
{
    auto from = static_cast<std::size_t>(loops_[k].partner);
    if (from == k) from = (k + 1) % loops_.size();
    const VectorXd source = arcs_around(angles_[from]) / (2.0 * pi);
    const auto of = [&](std::size_t loop) { return inverse_factor.middleCols(begin_[loop], angles_[loop].size()); };
    // f = N (s - E q) + c is 0 on k, and q has the sum of s: N_kk q = (N s)_k + c.
    const VectorXd seen = of(k).transpose() * (of(from) * source);
    const Eigen::Index n = seen.size();
    MatrixXd right(n, 2);
    right << seen, VectorXd::Ones(n);
    const MatrixXd both = spd_solve(gram(of(k)), right);
    return both.col(0) + both.col(1) * ((1.0 - both.col(0).sum()) / both.col(1).sum());
}

/// Ascending angles along a loop from those along its other side, which runs in reverse.
VectorXd GluedState::seen_from_the_other_side(std::size_t k, const VectorXd& angles) const
{
    const std::vector<Index>& matches = loops_[k].matches;
    VectorXd result(angles.size());
    for (Eigen::Index b = 0; b < result.size(); ++b) {
        result[b] = -angles[matches[b]];
        if (b > 0) result[b] -= 2.0 * pi * std::floor((result[b] - result[b - 1]) / (2.0 * pi));
    }
    return result;
}

std::vector<VectorXcd> GluedState::split(const MatrixXd& z) const
{
    std::vector<VectorXcd> result;
    for (std::size_t k = 0; k < loops_.size(); ++k) {
        const auto rows = z.middleRows(begin_[k], angles_[k].size());
        result.emplace_back(rows.col(0) + Complex(0.0, 1.0) * rows.col(1));
    }
    return result;
}

}  // namespace koebe
