// The places of a matrix's entries in the blocks of its supernodes. For the .cpp files of linear/ only.
#pragma once

#include "linear/factor/supernodes.h"

#include <vector>

namespace koebe::detail {

struct MatrixPlaces {
    std::vector<Index> begin;  ///< first entry of each supernode, and the end
    std::vector<Index> entry;  ///< number of each entry in the matrix's own order
    std::vector<Index> place;  ///< place of each entry in the block
};

/// The places of a matrix that keeps its pattern. The search for them takes twice the time that one use of them saves.
class LastPattern {
public:
    /// @param matrix the lower triangle, or both triangles @return null if a search does not pay yet
    const MatrixPlaces* places(const SparseMatrix& matrix, const Supernodes& l);

private:
    bool is_of(const SparseMatrix& matrix) const;
    void take(const SparseMatrix& matrix);
    void find_places(const Supernodes& l);

    std::vector<Index> outer_, inner_;
    bool has_both_ = false;  // both triangles
    MatrixPlaces places_;
};

}  // namespace koebe::detail
