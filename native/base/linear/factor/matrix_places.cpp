#include "linear/factor/matrix_places.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace koebe::detail {

bool LastPattern::is_of(const SparseMatrix& matrix) const
{
    const Index *outer = matrix.outerIndexPtr(), *inner = matrix.innerIndexPtr();
    return std::equal(outer_.begin(), outer_.end(), outer, outer + matrix.cols() + 1) &&
           std::equal(inner_.begin(), inner_.end(), inner, inner + matrix.nonZeros());
}

void LastPattern::take(const SparseMatrix& matrix)
{
    outer_.assign(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.cols() + 1);
    inner_.assign(matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros());
    places_ = {};
    has_both_ = false;
    for (Index c = 0; c + 1 < static_cast<Index>(outer_.size()) && !has_both_; ++c)
        has_both_ = outer_[c] < outer_[c + 1] && inner_[outer_[c]] < c;
}

void LastPattern::find_places(const Supernodes& l)
{
    const auto each_entry = [&](const auto& visit) {
        for (Index c = 0; c + 1 < static_cast<Index>(outer_.size()); ++c)
            for (Index e = outer_[c]; e < outer_[c + 1]; ++e)
                if (inner_[e] >= c) {
                    const auto [column, row] = std::minmax(l.rank[inner_[e]], l.rank[c]);
                    visit(e, column, row);
                }
    };
    std::vector<Index>& begin = places_.begin;
    begin.assign(l.count() + 1, 0);
    each_entry([&](Index, Index column, Index) { ++begin[l.supernode[column] + 1]; });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    places_.entry.resize(begin.back());
    places_.place.resize(begin.back());
    std::vector<std::pair<Index, Index>> at(begin.back());  // column and row of each entry
    std::vector<Index> end(begin.begin(), begin.end() - 1);
    each_entry([&](Index e, Index column, Index row) {
        const Index i = end[l.supernode[column]]++;
        places_.entry[i] = e;
        at[i] = {column, row};
    });
    std::vector<Index> row_of(l.size());  // in the block of a supernode
    for (Index s = 0; s < l.count(); ++s) {
        const Index height = l.height(s);
        for (Index i = 0; i < height; ++i) row_of[l.rows_of(s)[i]] = i;
        for (Index i = begin[s]; i < begin[s + 1]; ++i)
            places_.place[i] = row_of[at[i].second] + (at[i].first - l.first[s]) * height;
    }
}

const MatrixPlaces* LastPattern::places(const SparseMatrix& matrix, const Supernodes& l)
{
    const bool known = is_of(matrix);
    if (!known) take(matrix);
    if (places_.begin.empty() && (known || !has_both_)) find_places(l);
    return places_.begin.empty() ? nullptr : &places_;
}

}  // namespace koebe::detail
