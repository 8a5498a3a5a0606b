#include "certified/capacity_bounds.h"

#include "core/connectivity.h"
#include "execution/thread_share.h"
#include "linear/dense_spd.h"

#include <algorithm>

namespace koebe {
namespace {

constexpr std::size_t summands = 1024;  // short sums round less

/// Loads sum to 0 over the vertices, so that a diagonal added at one changes nothing but the constant.
SparseMatrix pinned(SparseMatrix matrix)
{
    matrix.coeffRef(0, 0) *= 2.0;
    return matrix;
}

}  // namespace

CapacityBounds::CapacityBounds(const BisectedSurface& surface, const QuadraticFunctions& functions,
                               const EdgeLengths& weights, const SparseMatrix& energy, std::vector<int> held)
    : surface_(surface),
      functions_(functions),
      weights_(weights),
      energy_(energy),
      held_(std::move(held)),
      fixed_(functions.size(), 0),
      tree_(surface),
      collapse_(make_collapse()),
      potential_(energy, fixed_),
      conjugate_(pinned(collapse_.transpose() * energy * collapse_))
{
}

std::vector<Interval> CapacityBounds::enclose(const std::vector<Condenser>& all, VectorXd& gap) const
{
    // Upper bound: the energy of a potential with these values on the loops (Dirichlet).
    const MatrixXd values = loop_values(all);
    MatrixXd u = potential_.solve(values);
    for (Index i = 0; i < functions_.size(); ++i)
        if (fixed_[i]) u.row(i) = values.row(i);
    // Lower bound: a flux without divergence that leaves each loop as the potential's does (Thomson).
    const MatrixXd source = energy_ * u;
    MatrixXd load(functions_.size(), u.cols());
    std::vector<OneForm> carried;
    std::vector<double> total;
    for (Eigen::Index c = 0; c < u.cols(); ++c) {
        VectorXd flux = VectorXd::Zero(surface_.loop_count());
        for (Index v = 0; v < surface_.vertex_count(); ++v)
            if (fixed_[v]) flux[surface_.loop_of()[v]] += source(v, c);
        flux = rounded_fluxes(std::move(flux), held_);
        total.push_back(0.0);
        for (const int k : all[c].at_one) total.back() += flux[k];
        carried.push_back(tree_.carry(flux));
        load.col(c) = functions_.load(weights_, carried.back());
    }
    // Its best part along stream functions, and both energies in intervals: capacity >= flux^2 / energy.
    const MatrixXd g = collapse_ * conjugate_.solve(collapse_.transpose() * load);
    std::vector<Interval> bounds;
    for (Eigen::Index c = 0; c < u.cols(); ++c) {
        const auto [upper, per_square] = energies(u.col(c), g.col(c), carried[c], gap);
        bounds.push_back({(squared(total[c]) / per_square).lower, upper.upper});
    }
    return bounds;
}

/// A function that is constant on each loop through which nothing flows, from one number for such a loop and the
/// coefficients elsewhere. Marks the coefficients on loops that are held.
SparseMatrix CapacityBounds::make_collapse()
{
    std::vector<Index> of_loop(surface_.loop_count(), -1);
    std::vector<Eigen::Triplet<double, Index>> entries;
    Index count = 0;
    std::vector<char> vanishes(functions_.size(), 0);
    for (Index h = 0; h < static_cast<Index>(surface_.twin().size()); ++h) {
        if (surface_.twin()[h] != no_twin) continue;
        const bool held = is_held(surface_.loop_of()[origin(surface_.triangles(), h)]);
        (held ? fixed_ : vanishes)[functions_.edge(h)] = 1;
    }
    for (Index i = 0; i < functions_.size(); ++i) {
        const int loop = i < surface_.vertex_count() ? surface_.loop_of()[i] : -1;
        if (vanishes[i]) continue;
        if (loop >= 0 && is_held(loop)) fixed_[i] = 1;
        const bool shared = loop >= 0 && !fixed_[i];
        if (!shared || of_loop[loop] < 0) ++count;
        if (shared && of_loop[loop] < 0) of_loop[loop] = count - 1;
        entries.emplace_back(i, shared ? of_loop[loop] : count - 1, 1.0);
    }
    SparseMatrix collapse(functions_.size(), count);
    collapse.setFromTriplets(entries.begin(), entries.end());
    return collapse;
}

bool CapacityBounds::is_held(int loop) const { return std::ranges::binary_search(held_, loop); }

MatrixXd CapacityBounds::loop_values(const std::vector<Condenser>& all) const
{
    MatrixXd values = MatrixXd::Zero(functions_.size(), static_cast<Eigen::Index>(all.size()));
    for (std::size_t c = 0; c < all.size(); ++c)
        for (Index v = 0; v < surface_.vertex_count(); ++v)
            if (std::ranges::find(all[c].at_one, surface_.loop_of()[v]) != all[c].at_one.end())
                values(v, static_cast<Eigen::Index>(c)) = 1.0;
    return values;
}

/// The energies of u and of the flux dg + carried.
std::pair<Interval, Interval> CapacityBounds::energies(const VectorXd& u, const VectorXd& g, const OneForm& carried,
                                                       VectorXd& gap) const
{
    const std::size_t count = static_cast<std::size_t>(surface_.face_count());
    std::vector<std::pair<Interval, Interval>> sums((count + summands - 1) / summands);
    in_pieces(count, summands, [&](std::size_t begin, std::size_t end) {
        std::pair<Interval, Interval> sum;
        for (Index f = static_cast<Index>(begin); f < static_cast<Index>(end); ++f)
            for (int m = 0; m < 3; ++m) {
                const auto [u1, u2] = functions_.covector(u, nullptr, f, m);
                const auto [g1, g2] = functions_.covector(g, &carried, f, m);
                const Interval of_u = surface_.energy(f, u1, u2), of_flux = surface_.energy(f, g1, g2);
                sum.first = sum.first + of_u;
                sum.second = sum.second + of_flux;
                // |grad u - flux|^2; the flux is dg + carried, turned by 90 degrees.
                gap[f] += std::max(of_u.upper + of_flux.upper - (u1.upper * g2.upper - u2.upper * g1.upper), 0.0);
            }
        sums[begin / summands] = sum;
    });
    std::pair<Interval, Interval> sum;
    for (const auto& [of_u, of_flux] : sums) sum = {sum.first + of_u, sum.second + of_flux};
    return {sum.first / 3.0, sum.second / 3.0};
}

}  // namespace koebe
