// Bounds of capacities on one triangulation.
#pragma once

#include "certified/bisected_surface.h"
#include "certified/condenser.h"
#include "certified/flux_tree.h"
#include "certified/interval.h"
#include "certified/interval_functions.h"
#include "certified/quadratic_functions.h"
#include "linear/sparse_cholesky.h"

#include <utility>
#include <vector>

namespace koebe {

/// The bounds for condensers that hold the same loops: they share the factors.
class CapacityBounds {
public:
    /// @param weights, energy half cotangents and the energy of the functions @param held loops, ascending
    CapacityBounds(const BisectedSurface& surface, const QuadraticFunctions& functions, const EdgeLengths& weights,
                   const SparseMatrix& energy, std::vector<int> held);

    /// @param gap (F) each triangle's part of the gap is added to it
    std::vector<Interval> enclose(const std::vector<Condenser>& all, VectorXd& gap) const;

private:
    SparseMatrix make_collapse();
    bool is_held(int loop) const;
    MatrixXd loop_values(const std::vector<Condenser>& all) const;
    std::pair<Interval, Interval> energies(const VectorXd& u, const VectorXd& g, const OneForm& carried,
                                           VectorXd& gap) const;

    const BisectedSurface& surface_;
    const QuadraticFunctions& functions_;
    const EdgeLengths& weights_;
    const SparseMatrix& energy_;
    std::vector<int> held_;
    std::vector<char> fixed_;
    FluxTree tree_;
    SparseMatrix collapse_;
    DirichletSolver potential_;
    SparseCholesky conjugate_;
};

}  // namespace koebe
