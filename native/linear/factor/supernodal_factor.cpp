#include "linear/factor/supernodal_factor.h"

#include "linear/factor/front.h"

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
    const bool permuted = system == CHOLMOD_A;
    MatrixXd x(right_hand_side.rows(), right_hand_side.cols());
    if (permuted)
        for (Index j = 0; j < size(); ++j) x.row(j) = right_hand_side.row(order()[j]);
    else
        x = right_hand_side;
    if (system != CHOLMOD_Lt) split ? split->solve_lower(x) : solve_lower(x);
    if (system != CHOLMOD_L) split ? split->solve_upper(x) : solve_upper(x);
    if (!permuted) return x;
    for (Index j = 0; j < size(); ++j) result.row(order()[j]) = x.row(j);
    return result;
}

void SupernodalFactor::solve_lower(MatrixXd& x) const
{
    MatrixXd update;
    for (Index s = 0; s < supernode_count(); ++s) {
        substitute_forward(values(s), height(s), width(s), first_column(s), x, update);
        const Index* below = rows(s) + width(s);
        for (Index r = 0; r < static_cast<Index>(update.rows()); ++r) x.row(below[r]) += update.row(r);
    }
}

void SupernodalFactor::solve_upper(MatrixXd& x) const
{
    for (Index s = supernode_count(); s-- > 0;)
        substitute_backward(values(s), height(s), width(s), first_column(s), rows(s) + width(s), x);
}

}  // namespace koebe::detail
