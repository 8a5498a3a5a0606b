#include "linear/factor/elimination_order.h"

namespace koebe::detail {

std::vector<Index> elimination_order(const SparseMatrix& matrix, const std::vector<Index>& last, bool postordered,
                                     CholmodCommon& common)
{
    const Index vertex_count = static_cast<Index>(matrix.rows());
    std::vector<Index> rank(vertex_count, 0);
    for (const Index v : last) rank[v] = -1;
    std::vector<Index> inner;
    for (Index v = 0; v < vertex_count; ++v)
        if (rank[v] == 0) {
            rank[v] = static_cast<Index>(inner.size());
            inner.push_back(v);
        }

    // The lower triangle of the block that has no row of `last`.
    SparseMatrix block(inner.size(), inner.size());
    block.reserve(matrix.nonZeros());
    for (std::size_t c = 0; c < inner.size(); ++c) {
        block.startVec(c);
        for (SparseMatrix::InnerIterator it(matrix, inner[c]); it; ++it)
            if (rank[it.row()] >= static_cast<Index>(c)) block.insertBack(rank[it.row()], c) = it.value();
    }
    block.finalize();

    // AMD: of its minimum degree order a postordering has the same fill, and supernodes side by side.
    std::vector<Index> order(inner.size());
    if (!inner.empty()) {
        cholmod_sparse lower = view(block, -1);
        if (postordered) {
            common->nmethods = 1;
            common->method[0].ordering = CHOLMOD_AMD;
            common->postorder = 1;
            const Factor symbolic = own(cholmod_analyze(&lower, common.get()), common);
            common.require(symbolic != nullptr, "ordering");
            const Index* perm = static_cast<const Index*>(symbolic->Perm);
            order.assign(perm, perm + inner.size());
        } else {
            common.require(cholmod_amd(&lower, nullptr, 0, order.data(), common.get()) != 0, "ordering");
        }
    }
    for (Index& v : order) v = inner[v];
    order.insert(order.end(), last.begin(), last.end());
    return order;
}

std::vector<Index> elimination_order_by_fill(const SparseMatrix& matrix, const std::vector<Index>& last,
                                             CholmodCommon& common)
{
    std::vector<Index> order(matrix.rows());
    cholmod_sparse lower = view(matrix, -1);
    common.require(cholmod_amd(&lower, nullptr, 0, order.data(), common.get()) != 0, "ordering");
    std::vector<char> is_last(matrix.rows(), 0);
    for (const Index v : last) is_last[v] = 1;
    std::erase_if(order, [&](Index v) { return is_last[v] != 0; });
    order.insert(order.end(), last.begin(), last.end());
    return order;
}

}  // namespace koebe::detail
