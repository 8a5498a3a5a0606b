// A Cholesky factor of which a part is computed anew. For the .cpp files of linear/ only.
#pragma once

#include "linear/factor/subtrees.h"
#include "linear/factor/supernodal_factor.h"

#include <vector>

namespace koebe::detail {

/// A = L L' by the multifrontal method (Duff and Reid 1983): each supernode J with the rows R below it has a front of
/// the rows (J, R), into which go the columns J of A and what its children in the elimination tree have left over; J is
/// eliminated, and what is left on R goes on to the parent. Where A changes in a few rows, only the supernodes from
/// those up to the root have to be computed anew: what the others leave over is kept.
class MultifrontalFactor {
public:
    /// @param l gets the values
    /// @param matrix A, of which the lower triangle is read
    /// @param changing rows of A: what refactorize() adds, it adds to entries between these
    MultifrontalFactor(SupernodalFactor& l, const SparseMatrix& matrix,
                       const std::vector<std::vector<Index>>& changing);

    /// Another A with the same pattern; there is no factor then before refactorize().
    /// @throws SolverError if it is not positive definite where nothing changes
    void take(const SparseMatrix& matrix);

    /// The factor of A + the sum of symmetric blocks, each on the rows of one set of `changing`; A has an entry, if
    /// only an explicit 0, between any two rows of a set.
    /// @throws SolverError if that is not positive definite
    void refactorize(const std::vector<MatrixXd>& blocks);

private:
    /// An entry of a block: (row, column) of set `set` goes to `place` of the columns of its supernode.
    struct Addend {
        Index set, row, column;
        std::ptrdiff_t place;
    };

    void find_addends(const std::vector<std::vector<Index>>& changing);
    void add_children(Index s, bool changing);
    void eliminate(Index s);

    SupernodalFactor& l_;
    std::vector<char> changes_;                       // per supernode
    Subtrees all_, changing_;                         // supernodes, and those that change
    std::vector<std::vector<Index>> children_;        // per supernode
    std::vector<std::vector<Index>> place_;           // per supernode, of its rows below among the rows of its parent
    std::vector<MatrixXd> left_;                      // per supernode what it leaves over, lower triangle
    std::vector<MatrixXd> kept_columns_, kept_left_;  // per changing supernode: its front without what changes
    std::vector<std::vector<Addend>> addends_;        // per supernode
};

}  // namespace koebe::detail
