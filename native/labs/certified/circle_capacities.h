// The capacities of circle domains: of one domain, and how they change with its circles. Errors are bounded.
#pragma once

#include "certified/condenser.h"
#include "circles/circle.h"
#include "core/types.h"
#include "execution/execution.h"

#include <numeric>
#include <vector>

namespace koebe {

/// Capacities near one circle domain, as linear functions of its module m.
///
/// The harmonic measure u_i of inner circle i is approximated by
///
///     h_i = sum_k a_k (log |z - c_k| - log |D_k|) + Re sum_k sum_s (b_ks w_k^s - conj(b_ks) v_k^s),
///     w_k = r_k / (z - c_k),  v_k = r_k z / D_k,  D_k = 1 - conj(c_k) z,
///
/// harmonic in the domain, with coefficients that are linear in m. v_k is the mirror image of w_k in the unit circle,
/// so that h_i is 0 there. If |h_i - u_i| <= e_i on the inner circles, this holds inside too, by the maximum principle.
/// The flux of h_i out of circle j is exactly -2 pi a_j. Green's formula gives |flux - C_ij| <= e_i times the integral
/// of |du_j/dn|, which is 2 C_jj: the flux of u_j leaves through circle j and enters through the others. e_i is bounded
/// for all m in a box round the module: by samples on each circle, by how fast the Fourier coefficients of an analytic
/// function fall, and by the second derivative in m.
class CircleCapacities {
public:
    /// @param wanted_error of the harmonic measures, to aim at @throws Cancelled
    CircleCapacities(VectorXd module, double wanted_error, ExecutionContext& context);

    const VectorXd& module() const { return module_; }

    /// (N) the condensers' capacities at the module, and (N, 3 n - 6) their derivatives: the linear functions.
    /// @param condensers all circles held, numbered as the circles
    VectorXd values(const std::vector<Condenser>& condensers) const;
    MatrixXd gradients(const std::vector<Condenser>& condensers) const;

    /// (N) how far the linear functions are from the capacities, at most, for all modules in the box; infinite if
    /// circles of the box may meet, or if the series do not reach so far. @param reach (3 n - 6) half of the box's
    /// sides
    VectorXd errors(const std::vector<Condenser>& condensers, const VectorXd& reach) const;

private:
    static constexpr Eigen::Index samples_per_term = 6;

    struct Samples;       // values on the circles
    struct Coefficients;  // bounds of them

    void solve();
    bool add_terms(double wanted_error);
    void prove();
    void add_what_samples_miss(int b);
    VectorXd potential_errors(const VectorXd& reach) const;
    VectorXd sums_of_fluxes(const std::vector<Condenser>& condensers, const MatrixXd& coefficients) const;

    int inner() const { return static_cast<int>(circles_.size()) - 1; }
    Eigen::Index log_of(int k) const { return k - 1; }
    Eigen::Index pole_of(int k) const { return inner() + 2 * sum_of_terms(k - 1); }  ///< then Re and Im, s = 1, 2, ...
    Eigen::Index size() const { return pole_of(inner() + 1); }
    Eigen::Index samples_of(int b) const { return samples_per_term * terms_[b - 1]; }
    Eigen::Index first_sample_of(int b) const { return samples_per_term * sum_of_terms(b - 1); }
    Eigen::Index sum_of_terms(int circles) const  ///< of inner circles 1, 2, ...
    {
        return std::accumulate(terms_.begin(), terms_.begin() + circles, Eigen::Index(0));
    }

    VectorXd module_;
    std::vector<Circle> circles_;
    std::vector<Eigen::Index> terms_;    // of each inner circle
    MatrixXd coefficients_;              // (size, inner)
    std::vector<MatrixXd> derivatives_;  // of them, in each number of the module
    MatrixXd errors_;                    // (inner, inner) on circle 1, 2, ... of the potentials, at the module
    std::vector<MatrixXd> errors_of_derivatives_;  // likewise, per number of the module
};

}  // namespace koebe
