#include "linear/supernodal_factor.h"

#include <algorithm>

namespace koebe::detail {

void SupernodalFactor::number()
{
    if (split) {
        const SupernodeLayout& l = split->layout();
        size_ = static_cast<Index>(l.order.size());
        supernode_count_ = static_cast<Index>(l.first.size()) - 1;
        order_ = l.order.data();
        first_ = l.first.data();
        rows_ = l.rows.data();
        split_row_begin_ = l.row_begin.data();
    } else {
        size_ = static_cast<Index>(factor->n);
        supernode_count_ = static_cast<Index>(factor->nsuper);
        order_ = static_cast<const Index*>(factor->Perm);
        first_ = static_cast<const Index*>(factor->super);
        rows_ = static_cast<const Index*>(factor->s);
        row_begin_ = static_cast<const Index*>(factor->pi);
    }
    rank.resize(size());
    supernode.resize(size());
    for (Index j = 0; j < size(); ++j) rank[order()[j]] = j;
    for (Index s = 0; s < supernode_count(); ++s)
        std::fill(supernode.begin() + first_column(s), supernode.begin() + first_column(s + 1), s);
}

void SupernodalFactor::make_room()
{
    common.require(cholmod_change_factor(CHOLMOD_REAL, 1, 1, 1, 1, factor.get(), common.get()) != 0,
                   "room for the factor");
}

MatrixXd SupernodalFactor::trailing_block(Index count) const
{
    MatrixXd trailing = MatrixXd::Zero(count, count);
    const Index begin = size() - count;
    for (Index s = count > 0 ? supernode[begin] : supernode_count(); s < supernode_count(); ++s)
        for (Index column = std::max(first_column(s), begin); column < first_column(s + 1); ++column) {
            const Index at = column - first_column(s);
            const double* values_of_column = values(s) + static_cast<std::ptrdiff_t>(at) * height(s);
            for (Index r = at; r < height(s); ++r) trailing(rows(s)[r] - begin, column - begin) = values_of_column[r];
        }
    return trailing;
}

MatrixXd SupernodalFactor::solve(int system, const MatrixXd& right_hand_side)
{
    MatrixXd result(right_hand_side.rows(), right_hand_side.cols());
    if (result.size() == 0) return result;
    if (split) {
        const bool permuted = system == CHOLMOD_A;
        MatrixXd x(right_hand_side.rows(), right_hand_side.cols());
        if (permuted)
            for (Index j = 0; j < size(); ++j) x.row(j) = right_hand_side.row(order()[j]);
        else
            x = right_hand_side;
        if (system != CHOLMOD_Lt) split->solve_lower(x);
        if (system != CHOLMOD_L) split->solve_upper(x);
        if (!permuted) return x;
        for (Index j = 0; j < size(); ++j) result.row(order()[j]) = x.row(j);
        return result;
    }
    // CHOLMOD looks at its status after the last of three arrays alone: without memory for an earlier one it would
    // follow a null pointer. So those are ours.
    MatrixXd permuted(result.rows(), result.cols());
    cholmod_dense b = view(right_hand_side), x = view(result), y = view(permuted);
    cholmod_dense *x_at = &x, *y_at = &y, *e_at = nullptr;
    const SerialRegions serial;
    const bool solved =
        cholmod_solve2(system, factor.get(), &b, nullptr, &x_at, nullptr, &y_at, &e_at, common.get()) != 0;
    const Dense workspace = own(e_at, common);
    common.require(solved, "back-substitution");
    return result;
}

}  // namespace koebe::detail
