#include "balance/flux_balance.h"

#include "circles/crowded_circles.h"
#include "circles/moebius.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace koebe {
namespace {

constexpr double margin = 1.1;             // factor on the radius: distance of a moved circle from others
constexpr double small_radius = 1e-3;      // unit disk: about the resolution of the meshes
constexpr std::size_t most_small = 12;     // each costs three back-substitutions
constexpr double noticeable_offset = 0.5;  // offset over the radius: below that the fit is as good as the energy
constexpr double noticeable_scale = 0.25;  // change of the complex radius over the radius
constexpr int most_steps = 30;
constexpr int most_halvings = 16;
constexpr double concentric = 1e-6;  // of the inner radius

class SmallCircles {
public:
    SmallCircles(BoundarySolver& condensed, const SparseMatrix& laplacian, const std::vector<VertexLoop>& loops,
                 std::vector<Circle>& circles, MatrixXd& boundary, AnnulusPosition annulus)
        : condensed_(condensed),
          laplacian_(laplacian),
          loops_(loops),
          circles_(circles),
          points_(boundary.col(0) + Complex(0.0, 1.0) * boundary.col(1))
    {
        for (const VertexLoop& loop : loops) begin_.push_back(begin_.back() + static_cast<Eigen::Index>(loop.size()));
        for (std::size_t k = 1; k < loops.size(); ++k)
            if (annulus == AnnulusPosition::concentric || circles[k].radius < small_radius) small_.push_back(k);
        std::stable_sort(small_.begin(), small_.end(),
                         [&](std::size_t a, std::size_t b) { return circles[a].radius < circles[b].radius; });
        small_.resize(std::min(small_.size(), most_small));
    }

    const VectorXcd& points() const { return points_; }

    /// Two loops: puts the inner one's centre where no flux runs, then makes it concentric by a Moebius map, until both
    /// stay.
    void center_annulus()
    {
        MatrixXd indicator = MatrixXd::Zero(points_.size(), 1);
        indicator.bottomRows(size(1)).setOnes();
        const VectorXcd flux = flux_of(indicator);
        for (int step = 0; step < most_steps; ++step) {
            // By symmetry the flux of z through the loop is the sum of z times the flux of its indicator's extension.
            const Complex offset = -flux.cwiseProduct(points_).sum() / flux.tail(size(1)).sum();
            const Complex center = circles_[1].center + offset;
            if (!(std::abs(center) + circles_[1].radius < 1.0)) return;
            points_.tail(size(1)).array() += offset;
            circles_[1].center = center;
            const Moebius moebius = center_circle(circles_[1]);
            circles_[1] = {Complex(0.0, 0.0), moebius(circles_[1]).radius};
            points_ = moebius(points_);
            for (Eigen::Index b = 0; b < points_.size(); ++b)
                points_[b] *= (b < begin_[1] ? 1.0 : circles_[1].radius) / std::abs(points_[b]);
            if (std::abs(offset) <= concentric * circles_[1].radius) return;
        }
    }

    /// @return whether any circle moved
    bool minimize_energy()
    {
        // Columns 3 i, 3 i + 1, 3 i + 2: the indicator of small loop i, and cosine and sine along it.
        const Eigen::Index count = static_cast<Eigen::Index>(small_.size());
        MatrixXd patterns = MatrixXd::Zero(points_.size(), 3 * count);
        VectorXcd rest = points_;
        VectorXd hole_areas(count);
        for (Eigen::Index i = 0; i < count; ++i) {
            const std::size_t k = small_[i];
            const VectorXcd arms = (segment(points_, k).array() - circles_[k].center) / circles_[k].radius;
            patterns.block(begin_[k], 3 * i, size(k), 1).setOnes();
            patterns.block(begin_[k], 3 * i + 1, size(k), 1) = arms.real();
            patterns.block(begin_[k], 3 * i + 2, size(k), 1) = arms.imag();
            segment(rest, k).setZero();
            hole_areas[i] = 0.0;
            for (Eigen::Index b = 0; b < arms.size(); ++b)
                hole_areas[i] += std::abs((std::conj(arms[b]) * arms[(b + 1) % arms.size()]).imag());
        }
        const Eigen::MatrixXcd fluxes = combined(flux_of(patterns)), basis = combined(patterns.cast<Complex>());
        Eigen::MatrixXcd system = fluxes.adjoint() * basis;
        for (Eigen::Index i = 0; i < count; ++i) system(2 * i + 1, 2 * i + 1) += hole_areas[i];
        VectorXcd solution = -system.ldlt().solve(fluxes.adjoint() * rest);

        bool worthwhile = false;
        for (Eigen::Index i = 0; i < count; ++i) {
            const Circle& old = circles_[small_[i]];
            worthwhile = worthwhile || std::abs(solution[2 * i] - old.center) > noticeable_offset * old.radius ||
                         std::abs(solution[2 * i + 1] - old.radius) > noticeable_scale * old.radius;
        }
        if (!worthwhile) return false;
        const auto centers = Eigen::seqN(0, count, 2), radii = Eigen::seqN(1, count, 2);
        const Eigen::LDLT<Eigen::MatrixXcd> for_centers(Eigen::MatrixXcd(system(centers, centers)));
        const Eigen::MatrixXcd coupling = system(centers, radii);
        const VectorXcd rest_load = VectorXcd(fluxes.adjoint() * rest)(centers);
        std::vector<Circle> moved = circles_;
        for (int halving = 0; halving < most_halvings && solution.allFinite(); ++halving) {
            for (Eigen::Index i = 0; i < count; ++i)
                moved[small_[i]] = {solution[2 * i], std::abs(solution[2 * i + 1])};
            std::vector<std::size_t> crowded;
            for (const std::size_t k : small_)
                if (!is_apart(moved, k, margin)) crowded.push_back(k);
            if (crowded.empty()) {
                circles_ = moved;
                points_ = rest + basis * solution;
                return true;
            }
            // In a corner that is too narrow circles are made smaller, and their centres computed again.
            for (const std::size_t k : crowded)
                solution[2 * (std::find(small_.begin(), small_.end(), k) - small_.begin()) + 1] *= 0.5;
            solution(centers) = -for_centers.solve(rest_load + coupling * VectorXcd(solution(radii)));
        }
        return false;
    }

    /// Whether as much flux runs to a small circle as a noticeable offset would cause. @param uv the harmonic extension
    bool any_flux(const PlanarPoints& uv) const
    {
        return std::any_of(small_.begin(), small_.end(), [&](std::size_t k) {
            Eigen::RowVector2d flux(0.0, 0.0);
            for (const Index v : loops_[k])
                for (SparseMatrix::InnerIterator it(laplacian_, v); it; ++it) flux += it.value() * uv.row(it.row());
            // Ratio of flux to offset between concentric circles of radii r and 1.
            const double capacity = 2.0 * std::numbers::pi / std::log(1.0 / circles_[k].radius);
            return flux.norm() > noticeable_offset * capacity * circles_[k].radius;
        });
    }

private:
    Eigen::Index size(std::size_t k) const { return begin_[k + 1] - begin_[k]; }
    Eigen::VectorBlock<VectorXcd> segment(VectorXcd& values, std::size_t k) const
    {
        return values.segment(begin_[k], size(k));
    }

    /// Sigma times the patterns: the flux of their harmonic extensions at the boundary.
    Eigen::MatrixXcd flux_of(const MatrixXd& patterns) const
    {
        const MatrixXd everywhere = condensed_.extend(patterns);
        MatrixXd flux = MatrixXd::Zero(patterns.rows(), patterns.cols());
        Eigen::Index row = 0;
        for (const VertexLoop& loop : loops_)
            for (const Index v : loop) {
                for (SparseMatrix::InnerIterator it(laplacian_, v); it; ++it)
                    flux.row(row) += it.value() * everywhere.row(it.row());
                ++row;
            }
        return flux.cast<Complex>();
    }

    /// Combines each three columns 1, cos, sin into the two 1 and cos + i sin.
    static Eigen::MatrixXcd combined(const Eigen::MatrixXcd& columns)
    {
        Eigen::MatrixXcd result(columns.rows(), 2 * columns.cols() / 3);
        for (Eigen::Index i = 0; 3 * i < columns.cols(); ++i) {
            result.col(2 * i) = columns.col(3 * i);
            result.col(2 * i + 1) = columns.col(3 * i + 1) + Complex(0.0, 1.0) * columns.col(3 * i + 2);
        }
        return result;
    }

    BoundarySolver& condensed_;
    const SparseMatrix& laplacian_;
    const std::vector<VertexLoop>& loops_;
    std::vector<Circle>& circles_;
    VectorXcd points_;
    std::vector<Eigen::Index> begin_{0};
    std::vector<std::size_t> small_;  // the smallest first
};

}  // namespace

PlanarPoints balance_flux(BoundarySolver& condensed, const SparseMatrix& laplacian,
                          const std::vector<VertexLoop>& loops, std::vector<Circle>& circles, MatrixXd& boundary,
                          AnnulusPosition annulus)
{
    if (loops.size() != 2) annulus = AnnulusPosition::free;
    SmallCircles small(condensed, laplacian, loops, circles, boundary, annulus);
    PlanarPoints uv;
    if (annulus == AnnulusPosition::concentric) {
        small.center_annulus();
    } else {
        uv = condensed.extend(boundary);
        if (!small.any_flux(uv) || !small.minimize_energy()) return uv;
    }
    boundary << small.points().real(), small.points().imag();
    return condensed.extend(boundary);
}

}  // namespace koebe
