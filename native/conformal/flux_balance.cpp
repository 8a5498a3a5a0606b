#include "conformal/flux_balance.h"

#include "conformal/moebius.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace koebe {
namespace {

constexpr double small_radius = 1e-3;  // unit disk: about what the meshes resolve
constexpr std::size_t most_small = 64; // each costs a back-substitution
constexpr double noticeable = 0.05;    // offset over the radius: the fit is as good as the flux below that
constexpr int most_steps = 30;
constexpr double concentric = 1e-6;    // of the inner radius

}  // namespace

void balance_flux(const CondensedLaplacian& condensed, const SparseMatrix& laplacian,
                  const std::vector<VertexLoop>& loops, std::vector<Circle>& circles, MatrixXd& boundary)
{
    const bool annulus = loops.size() == 2;
    std::vector<std::size_t> small;
    for (std::size_t k = 1; k < loops.size(); ++k)
        if (annulus || circles[k].radius < small_radius) small.push_back(k);
    std::stable_sort(small.begin(), small.end(),
                     [&](std::size_t a, std::size_t b) { return circles[a].radius < circles[b].radius; });
    small.resize(std::min(small.size(), most_small));
    if (small.empty()) return;

    std::vector<Eigen::Index> begin{0};
    for (const VertexLoop& loop : loops) begin.push_back(begin.back() + static_cast<Eigen::Index>(loop.size()));
    const Eigen::Index m = begin.back(), count = static_cast<Eigen::Index>(small.size());
    const auto rows = [&](auto& matrix, std::size_t k) {
        return matrix.middleRows(begin[k], begin[k + 1] - begin[k]);
    };
    MatrixXd indicators = MatrixXd::Zero(m, count);
    for (Eigen::Index i = 0; i < count; ++i) rows(indicators, small[i]).col(i).setOnes();
    // By symmetry the flux of z through loop k is the sum of z times the flux of the extension of its indicator.
    const MatrixXd all_fluxes = laplacian * condensed.extend(indicators);
    MatrixXd fluxes(m, count);
    Eigen::Index row = 0;
    for (const VertexLoop& loop : loops)
        for (const Index v : loop) fluxes.row(row++) = all_fluxes.row(v);
    const Eigen::LDLT<MatrixXd> response(fluxes.transpose() * indicators);

    for (int step = 0; step < (annulus ? most_steps : 1); ++step) {
        const MatrixXd offsets = -response.solve(fluxes.transpose() * boundary);
        double worst = 0.0;
        for (Eigen::Index i = 0; i < count; ++i)
            worst = std::max(worst, offsets.row(i).norm() / circles[small[i]].radius);
        if (!std::isfinite(worst) || (step == 0 && worst < noticeable)) return;
        for (Eigen::Index i = 0; i < count; ++i) {
            rows(boundary, small[i]).rowwise() += offsets.row(i);
            circles[small[i]].center += Complex(offsets(i, 0), offsets(i, 1));
        }
        if (!annulus) return;
        if (std::abs(circles[1].center) < concentric * circles[1].radius) {
            rows(boundary, 1).rowwise() -= Eigen::RowVector2d(circles[1].center.real(), circles[1].center.imag());
            circles[1].center = 0.0;
            return;
        }
        const Moebius moebius = center_circle(circles[1]);
        circles[1] = {Complex(0.0, 0.0), moebius(circles[1]).radius};
        VectorXcd points = moebius(boundary.col(0) + Complex(0.0, 1.0) * boundary.col(1));
        for (Eigen::Index b = 0; b < m; ++b)
            points[b] *= (b < begin[1] ? 1.0 : circles[1].radius) / std::abs(points[b]);
        boundary << points.real(), points.imag();
    }
}

}  // namespace koebe
