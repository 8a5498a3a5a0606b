// The numbers of a factor that CHOLMOD has analyzed. For the .cpp files of linear/ only.
#pragma once

#include "linear/factor/piece_factor.h"
#include "linear/factor/supernodal_factor.h"

#include <vector>

namespace koebe::detail {

/// CHOLMOD's supernodes, and where each entry of the matrix stands in them; the numbers are made by factorize_piece.
/// CHOLMOD takes memory and a team of OpenMP for each supernode, which on meshes, where they are small, takes longer
/// than the numbers do.
class FactorNumbers {
public:
    /// @param l analyzed by CHOLMOD; gets room for the numbers
    explicit FactorNumbers(SupernodalFactor& l);

    /// @param matrix with no entries but those that were analyzed: the lower triangle, or both
    /// @throws SolverError if it is not positive definite; then there is no factor
    void take(const SparseMatrix& matrix);

private:
    bool has_pattern_of(const SparseMatrix& matrix) const;
    void take_pattern(const SparseMatrix& matrix);
    void find_places();

    SupernodalFactor& l_;
    SupernodeLayout layout_;
    SplitPart whole_;
    std::vector<Index> outer_, inner_;  // the last matrix' pattern
    bool has_both_ = false;             // triangles
    MatrixPlaces places_;  // in it, from its second matrix on: finding them takes as long as they save twice
};

}  // namespace koebe::detail
