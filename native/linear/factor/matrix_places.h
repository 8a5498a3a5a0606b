// Where the entries of a matrix stand in the blocks of its supernodes. For the .cpp files of linear/ only.
#pragma once

#include "linear/factor/supernodes.h"

#include <vector>

namespace koebe::detail {

struct MatrixPlaces {
    std::vector<Index> begin;  ///< of each supernode's entries, and the end
    std::vector<Index> entry;  ///< number among the matrix' own
    std::vector<Index> place;  ///< in the block
};

/// The places of a matrix that changes, but not its pattern: finding them takes twice as long as they save.
class LastPattern {
public:
    /// @param matrix the lower triangle, or both @return none where they are not worth finding yet
    const MatrixPlaces* places(const SparseMatrix& matrix, const Supernodes& l);

private:
    bool is_of(const SparseMatrix& matrix) const;
    void take(const SparseMatrix& matrix);
    void find_places(const Supernodes& l);

    std::vector<Index> outer_, inner_;
    bool has_both_ = false;  // triangles
    MatrixPlaces places_;
};

}  // namespace koebe::detail
