#include "linear/factor_numbers.h"

#include <algorithm>
#include <numeric>

namespace koebe::detail {

FactorNumbers::FactorNumbers(SupernodalFactor& l) : l_(l)
{
    l.make_room();
    const Index count = l.supernode_count();
    layout_.order.assign(l.order(), l.order() + l.size());
    layout_.rank = l.rank;
    for (Index s = 0; s <= count; ++s) {
        layout_.first.push_back(l.first_column(s));
        layout_.row_begin.push_back(l.rows(s) - l.rows(0));
    }
    layout_.rows.assign(l.rows(0), l.rows(count));
    const Index* const begin = static_cast<const Index*>(l.factor->px);
    layout_.value_begin.assign(begin, begin + count + 1);
    whole_.end = l.size();
    whole_.last_supernode = count;
}

bool FactorNumbers::has_pattern_of(const SparseMatrix& matrix) const
{
    const Index *outer = matrix.outerIndexPtr(), *inner = matrix.innerIndexPtr();
    return std::equal(outer_.begin(), outer_.end(), outer, outer + matrix.cols() + 1) &&
           std::equal(inner_.begin(), inner_.end(), inner, inner + matrix.nonZeros());
}

void FactorNumbers::take_pattern(const SparseMatrix& matrix)
{
    outer_.assign(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.cols() + 1);
    inner_.assign(matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros());
    places_ = {};
    has_both_ = false;
    for (Index c = 0; c + 1 < static_cast<Index>(outer_.size()) && !has_both_; ++c)
        has_both_ = outer_[c] < outer_[c + 1] && inner_[outer_[c]] < c;
}

void FactorNumbers::find_places()
{
    const auto each_entry = [&](const auto& visit) {
        for (Index c = 0; c + 1 < static_cast<Index>(outer_.size()); ++c)
            for (Index e = outer_[c]; e < outer_[c + 1]; ++e)
                if (inner_[e] >= c) {
                    const auto [column, row] = std::minmax(l_.rank[inner_[e]], l_.rank[c]);
                    visit(e, column, row);
                }
    };
    std::vector<Index>& begin = places_.begin;
    begin.assign(l_.supernode_count() + 1, 0);
    each_entry([&](Index, Index column, Index) { ++begin[l_.supernode[column] + 1]; });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    places_.entry.resize(begin.back());
    places_.place.resize(begin.back());
    std::vector<Index> end(begin.begin(), begin.end() - 1);
    each_entry([&](Index e, Index column, Index row) {
        const Index s = l_.supernode[column], height = l_.height(s);
        const Index* rows = l_.rows(s);
        places_.entry[end[s]] = e;
        places_.place[end[s]++] = static_cast<Index>(std::lower_bound(rows, rows + height, row) - rows) +
                                  (column - l_.first_column(s)) * height;
    });
}

void FactorNumbers::take(const SparseMatrix& matrix)
{
    const bool known = has_pattern_of(matrix);
    if (!known) take_pattern(matrix);
    if (places_.begin.empty() && (known || !has_both_)) find_places();
    factorize_piece(matrix, layout_, whole_, l_.size(), static_cast<double*>(l_.factor->x), {},
                    places_.begin.empty() ? nullptr : &places_);
}

}  // namespace koebe::detail
