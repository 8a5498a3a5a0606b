// The sparse factor of a surface with changing disks in its loops.
#pragma once

#include "core/types.h"
#include "linear/boundary_solver.h"
#include "linear/ground_columns.h"
#include "linear/sparse_cholesky.h"

#include <utility>
#include <vector>

namespace koebe {

/// The disk in a loop. A loop with more than `most_dense` vertices has nodes, as many as nodes() says: a stiff spring
/// ties each node to a mean of loop vertices, and the disk is on the nodes alone.
struct LoopDisk {
    MatrixXd stiffness;           ///< T, (n, n), of the loop's vertices or of its nodes
    std::vector<VectorXd> means;  ///< per node: the weight of each vertex of its mean, sum 1; empty without nodes
};

/// For long boundaries, where no dense matrix is kept. Factors K with disks in the loops. The first loop is grounded,
/// and the other loops are in AMD's order. fill() takes other disks, and recomputes only the rows that depend on them.
/// To factor K_II, a large number replaces the disks.
class FilledLaplacian final : public BoundarySolver {
public:
    /// @param laplacian (V, V) cotan Laplacian, stored with its upper and its lower triangle
    /// @param loops the whole boundary, two loops or more; it keeps its order
    /// @throws SolverError if K is not positive definite on rows that no disk reaches. If K_II is not positive definite
    /// on other rows, extend() and solve_interior() return NaN
    FilledLaplacian(const SparseMatrix& laplacian, const std::vector<std::vector<Index>>& loops);

    void renew(const SparseMatrix& laplacian) override;
    bool reorder_boundary(const std::vector<Index>&) override { return false; }
    Index boundary_size() const override { return boundary_.size(); }
    MatrixXd extend(const MatrixXd& boundary_values) override;
    InteriorSolution solve_interior(const VectorXd& load) override;

    /// Nodes lie at every few vertices, from the first on. For each node the places on the loop of its mean's vertices,
    /// in order: those between the nodes before and after it.
    /// Empty if the loop has few vertices, and no nodes.
    static std::vector<std::vector<Index>> nodes(Index loop_size);

    /// Rows of the factor: K's, then all nodes.
    Index factor_size() const { return factor_size_; }

    /// Factors K plus one disk for each loop after the first, with rows in the constructor's order. The first loop is
    /// grounded, with 1 on the diagonal. The last rows of the factor are the second loop's, or its nodes. Any other
    /// call invalidates the factor.
    /// @throws SolverError if the sum is not positive definite
    const SparseCholesky& fill(const std::vector<LoopDisk>& disks);

    /// u with K u = 0 where no loop is, 1 on loop k, which has nodes, 0 on the first loop, and these disks in all other
    /// loops: its rows in `wanted` (wanted), and its flux through loop k (n_k).
    std::pair<VectorXd, VectorXd> raise(int k, const std::vector<LoopDisk>& disks, const std::vector<Index>& wanted);

private:
    struct NodedLoop {
        std::size_t loop;                      // its number
        Index first_node;                      // row
        std::vector<std::vector<Index>> ties;  // places on the loop
        GroundColumns columns;                 // of K at the loop
    };

    SparseMatrix with_nodes(const SparseMatrix& laplacian) const;
    std::vector<std::vector<Index>> disk_rows() const;
    std::vector<std::vector<Index>> changing_rows() const;
    std::vector<MatrixXd> blocks(const std::vector<LoopDisk>& disks, int held) const;
    std::vector<MatrixXd> stiff_blocks() const;
    MatrixXd solve_inside(MatrixXd load);

    std::vector<std::vector<Index>> loops_;
    GroundColumns boundary_;
    std::vector<NodedLoop> noded_;
    Index surface_size_, factor_size_;  // rows of K, and with the nodes
    double stiff_ = 1.0;                // holds a vertex at 0
    SparseCholesky cholesky_;
    bool is_filled_ = true;  // whether the factor is for disks
};

}  // namespace koebe
