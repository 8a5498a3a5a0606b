// Substitution on a part of a factor. For the .cpp files of linear/ only.
#pragma once

#include "linear/factor/supernodal_factor.h"

#include <vector>

namespace koebe::detail {

/// Solves with L and L' where right-hand sides vanish but on a few rows, or solutions are wanted on a few: only the
/// supernodes on the way from those to the root of the elimination tree are visited (Gilbert 1994).
class PartSubstitution {
public:
    explicit PartSubstitution(const SupernodalFactor& l) : l_(l) {}

    /// L y = f. @param f (n, C), in the order of A's rows @return (C, n), in the factor's order
    MatrixXd forward(const MatrixXd& f) const;

    /// L' x = y where x is wanted, and where it takes that from; y elsewhere. @param y as above, becomes x
    /// @param wanted rows of A
    void backward(MatrixXd& y, const std::vector<Index>& wanted) const;

private:
    std::vector<char> ways_from(const std::vector<Index>& rows) const;

    const SupernodalFactor& l_;
};

}  // namespace koebe::detail
