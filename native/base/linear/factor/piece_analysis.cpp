#include "linear/factor/piece_analysis.h"

#include "linear/cholmod_support.h"
#include "linear/factor/elimination_order.h"

#include <algorithm>
#include <numeric>

namespace koebe::detail {
namespace {

/// The piece's columns, lower triangle, then its interface with a diagonal only.
SparseMatrix with_interface(const SparseMatrix& matrix, const std::vector<Index>& rows,
                            const std::vector<Index>& interface, const std::vector<Index>& rank,
                            const std::vector<Index>& number)
{
    const Index size = static_cast<Index>(rows.size()), all = size + static_cast<Index>(interface.size());
    SparseMatrix result(all, all);
    std::size_t entries = interface.size();
    for (const Index v : rows) entries += matrix.outerIndexPtr()[v + 1] - matrix.outerIndexPtr()[v];
    result.reserve(static_cast<Eigen::Index>(entries));
    std::vector<Index> beyond;
    for (Index c = 0; c < size; ++c) {
        result.startVec(c);
        beyond.clear();
        for (SparseMatrix::InnerIterator it(matrix, rows[c]); it; ++it) {
            const Index w = static_cast<Index>(it.row());
            if (rank[w] >= 0)
                beyond.push_back(rank[w]);
            else if (number[w] >= c)
                result.insertBack(number[w], c) = it.value();
        }
        std::sort(beyond.begin(), beyond.end());
        for (const Index r : beyond)
            result.insertBack(size + (std::lower_bound(interface.begin(), interface.end(), r) - interface.begin()), c) =
                1.0;
    }
    for (Index c = size; c < all; ++c) {
        result.startVec(c);
        result.insertBack(c, c) = 1.0;
    }
    result.finalize();
    return result;
}

}  // namespace

PieceSupernodes analyze_piece(const SparseMatrix& matrix, const std::vector<Index>& rows,
                              const std::vector<Index>& interface, const std::vector<Index>& rank,
                              const std::vector<Index>& number)
{
    const Index size = static_cast<Index>(rows.size());
    const SparseMatrix own = with_interface(matrix, rows, interface, rank, number);
    std::vector<Index> last(interface.size());
    std::iota(last.begin(), last.end(), size);
    CholmodCommon common;
    std::vector<Index> order = elimination_order(own, last, true, common);
    common->nmethods = 1;
    common->method[0].ordering = CHOLMOD_GIVEN;
    common->postorder = 0;
    cholmod_sparse lower = view(own, -1);
    const Factor symbolic = detail::own(cholmod_analyze_p(&lower, order.data(), nullptr, 0, common.get()), common);
    common.require(symbolic != nullptr, "symbolic analysis");

    PieceSupernodes result;
    const Index* first = static_cast<const Index*>(symbolic->super);
    const Index* row_begin = static_cast<const Index*>(symbolic->pi);
    const Index* all_rows = static_cast<const Index*>(symbolic->s);
    // Cut a supernode off where it enters the interface.
    Index count = 0;
    while (count < static_cast<Index>(symbolic->nsuper) && first[count] < size) ++count;
    result.first.assign(first, first + count);
    result.first.push_back(size);
    result.row_begin.assign(row_begin, row_begin + count + 1);
    result.rows.assign(all_rows, all_rows + row_begin[count]);
    order.resize(size);
    for (const Index i : order) result.order.push_back(rows[i]);
    return result;
}

}  // namespace koebe::detail
