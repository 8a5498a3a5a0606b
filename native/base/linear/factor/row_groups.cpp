#include "linear/factor/row_groups.h"

#include <algorithm>

namespace koebe::detail {

RowGroups row_groups(const SparseMatrix& matrix)
{
    const Index size = static_cast<Index>(matrix.rows());
    const Index *outer = matrix.outerIndexPtr(), *inner = matrix.innerIndexPtr();
    std::vector<const Index*> begin(static_cast<std::size_t>(size));  // of each column's lower triangle
    for (Index c = 0; c < size; ++c) begin[c] = std::lower_bound(inner + outer[c], inner + outer[c + 1], c);
    const auto end = [&](Index c) { return inner + outer[c + 1]; };
    std::vector<char> joins(static_cast<std::size_t>(size) + 1, 0);  // whether a row is like the row before it
    for (Index c = 0; c + 1 < size; ++c)
        joins[c + 1] =
            begin[c] != end(c) && *begin[c] == c && std::equal(begin[c] + 1, end(c), begin[c + 1], end(c + 1));
    for (Index c = 0; c < size; ++c)
        for (const Index* at = begin[c]; at != end(c); ++at) {
            const Index row = *at;
            if (row > c && (at == begin[c] || at[-1] != row - 1)) joins[row] = 0;
            if (at + 1 == end(c) || at[1] != row + 1) joins[row + 1] = 0;
        }
    RowGroups groups;
    for (Index row = 0; row < size; ++row)
        if (!joins[row]) groups.first.push_back(row);
    groups.first.push_back(size);
    return groups;
}

SparseMatrix pattern_of_groups(const SparseMatrix& matrix, const RowGroups& groups)
{
    std::vector<Index> group_of(static_cast<std::size_t>(matrix.rows()), -1);  // of a group's first row
    for (Index g = 0; g < groups.count(); ++g) group_of[groups.first[g]] = g;
    std::vector<Index> rows, outer{0};
    for (Index g = 0; g < groups.count(); ++g) {
        for (SparseMatrix::InnerIterator it(matrix, groups.first[g]); it; ++it)
            if (const Index row = group_of[it.row()]; row >= g) rows.push_back(row);
        outer.push_back(static_cast<Index>(rows.size()));
    }
    SparseMatrix result(groups.count(), groups.count());
    result.resizeNonZeros(static_cast<Eigen::Index>(rows.size()));
    std::ranges::copy(outer, result.outerIndexPtr());
    std::ranges::copy(rows, result.innerIndexPtr());
    std::fill_n(result.valuePtr(), rows.size(), 0.0);
    return result;
}

Supernodes expanded(const Supernodes& of_groups, const RowGroups& groups)
{
    Supernodes result;
    std::vector<Index> begin{0};  // rank of the first row of each group, by the groups' ranks
    for (const Index g : of_groups.order) {
        for (Index row = groups.first[g]; row < groups.first[g + 1]; ++row) result.order.push_back(row);
        begin.push_back(static_cast<Index>(result.order.size()));
    }
    for (const Index first : of_groups.first) result.first.push_back(begin[first]);
    result.row_begin.push_back(0);
    result.value_begin.push_back(0);
    for (Index s = 0; s < of_groups.count(); ++s) {
        for (Index i = 0; i < of_groups.height(s); ++i) {
            const Index rank = of_groups.rows_of(s)[i];
            for (Index row = begin[rank]; row < begin[rank + 1]; ++row) result.rows.push_back(row);
        }
        result.row_begin.push_back(static_cast<std::ptrdiff_t>(result.rows.size()));
        result.value_begin.push_back(result.value_begin.back() +
                                     static_cast<std::ptrdiff_t>(result.width(s)) * result.height(s));
    }
    return result;
}

}  // namespace koebe::detail
