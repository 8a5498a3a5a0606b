#include "geometry/supernodal_factor.h"

#include <algorithm>

namespace koebe::detail {

void SupernodalFactor::number()
{
    rank.resize(size());
    supernode.resize(size());
    for (Index j = 0; j < size(); ++j) rank[order()[j]] = j;
    for (Index s = 0; s < static_cast<Index>(factor->nsuper); ++s)
        std::fill(supernode.begin() + first_column(s), supernode.begin() + first_column(s + 1), s);
}

MatrixXd SupernodalFactor::trailing_block(Index count) const
{
    MatrixXd trailing = MatrixXd::Zero(count, count);
    const Index begin = size() - count;
    for (Index s = count > 0 ? supernode[begin] : static_cast<Index>(factor->nsuper);
         s < static_cast<Index>(factor->nsuper); ++s)
        for (Index column = std::max(first_column(s), begin); column < first_column(s + 1); ++column) {
            const Index at = column - first_column(s);
            const double* values_of_column = values(s) + static_cast<std::ptrdiff_t>(at) * height(s);
            for (Index r = at; r < height(s); ++r) trailing(rows(s)[r] - begin, column - begin) = values_of_column[r];
        }
    return trailing;
}

MatrixXd SupernodalFactor::solve(int system, const MatrixXd& right_hand_side)
{
    cholmod_dense b = view(right_hand_side);
    const SerialRegions serial;
    const Dense x = own(cholmod_solve(system, factor.get(), &b, common.get()), common);
    common.require(x != nullptr, "back-substitution");
    return to_eigen(*x);
}

}  // namespace koebe::detail
