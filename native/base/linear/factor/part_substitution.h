// Substitution on a part of a factor. For the .cpp files of linear/ only.
#pragma once

#include "linear/factor/supernodal_factor.h"

#include <vector>

namespace koebe::detail {

/// Solves with L and L' if right-hand sides are 0 except on a few rows, or if only a few rows of the solution are
/// wanted. Visits only the supernodes from these rows up to the root of the elimination tree (Gilbert 1994).
class PartSubstitution {
public:
    explicit PartSubstitution(const SupernodalFactor& l) : l_(l) {}

    /// L y = f. @param f (n, C), in the order of A's rows @return (C, n), in the factor's order
    MatrixXd forward(const MatrixXd& f) const;

    /// Solves L' x = y for the wanted rows and the rows on which they depend. Other rows keep y.
    /// @param y as above, becomes x @param wanted rows of A
    void backward(MatrixXd& y, const std::vector<Index>& wanted) const;

private:
    std::vector<char> ways_from(const std::vector<Index>& rows) const;

    const SupernodalFactor& l_;
};

}  // namespace koebe::detail
