// A Cholesky factor that can be recomputed in part. For the .cpp files of linear/ only.
#pragma once

#include "linear/factor/subtrees.h"
#include "linear/factor/supernodal_factor.h"

#include <vector>

namespace koebe::detail {

/// A = L L' by the multifrontal method (Duff and Reid 1983). Supernode J with the rows R below it has a front of the
/// rows (J, R). The front adds up the columns J of A and the updates of J's children in the elimination tree. J is
/// eliminated, and the update on R goes to the parent. If A changes in a few rows, only the supernodes from these rows
/// up to the root are computed again; the updates of all other supernodes are kept.
class MultifrontalFactor {
public:
    /// @param l gets the values
    /// @param matrix A; its lower triangle is read
    /// @param changing sets of rows of A; refactorize() adds to entries within a set
    MultifrontalFactor(SupernodalFactor& l, const SparseMatrix& matrix,
                       const std::vector<std::vector<Index>>& changing);

    /// Takes another A with the same pattern. There is no factor until refactorize().
    /// @throws SolverError if A is not positive definite in the supernodes that do not change
    void take(const SparseMatrix& matrix);

    /// Factors A plus symmetric blocks, each on the rows of one set of `changing`. A has an entry, if only an explicit
    /// 0, between any two rows of a set.
    /// @throws SolverError if the sum is not positive definite
    void refactorize(const std::vector<MatrixXd>& blocks);

private:
    /// An entry of a block: (row, column) of set `set` goes to `place` in the columns of its supernode.
    struct Addend {
        Index set, row, column;
        std::ptrdiff_t place;
    };

    void find_addends(const std::vector<std::vector<Index>>& changing);
    void add_children(Index s, bool changing);
    void eliminate(Index s);

    SupernodalFactor& l_;
    std::vector<char> changes_;                       // per supernode
    Subtrees all_, changing_;                         // all supernodes, and the changing supernodes
    std::vector<std::vector<Index>> children_;        // per supernode
    std::vector<std::vector<Index>> place_;           // per supernode: place of each row below it in its parent
    std::vector<MatrixXd> left_;                      // per supernode: its update, lower triangle
    std::vector<MatrixXd> kept_columns_, kept_left_;  // per changing supernode: the unchanging part of its front
    std::vector<std::vector<Addend>> addends_;        // per supernode
};

}  // namespace koebe::detail
