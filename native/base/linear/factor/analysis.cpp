#include "linear/factor/analysis.h"

#include "core/errors.h"
#include "core/sort_unique.h"
#include "core/types.h"
#include "execution/profile.h"
#include "execution/thread_share.h"
#include "linear/cholmod_support.h"
#include "linear/factor/dissection.h"
#include "linear/factor/elimination_order.h"
#include "linear/factor/row_groups.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace koebe::detail {
namespace {

/// The supernodes of a piece of P rows. Row numbers below P are the piece's own in the order of elimination; P + i is
/// row i of its interface.
struct PieceSupernodes {
    std::vector<Index> order;  ///< rows of the matrix in the order of elimination
    std::vector<Index> first;  ///< first column of each supernode, and the end
    std::vector<Index> row_begin, rows;
};

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
    // The rows of the piece, then the interface, whose own block the symbolic analysis needs as a diagonal alone.
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

/// @param matrix both triangles
/// @param rows of the piece, ascending
/// @param interface in the factor's order, ascending
/// @param rank of rows outside pieces in the factor's order; -1 for rows of pieces
/// @param number of each row within its piece
PieceSupernodes analyze_piece(const SparseMatrix& matrix, const std::vector<Index>& rows,
                              const std::vector<Index>& interface, const std::vector<Index>& rank,
                              const std::vector<Index>& number)
{
    const Index size = static_cast<Index>(rows.size());
    const SparseMatrix bordered = with_interface(matrix, rows, interface, rank, number);
    std::vector<Index> last(interface.size());
    std::iota(last.begin(), last.end(), size);
    CholmodCommon common;
    std::vector<Index> order = elimination_order(bordered, last, true, common);
    common->nmethods = 1;
    common->method[0].ordering = CHOLMOD_GIVEN;
    common->postorder = 0;
    cholmod_sparse lower = view(bordered, -1);
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
    order.resize(size);  // the interface comes last: only the piece's own rows stay
    for (const Index i : order) result.order.push_back(rows[i]);
    return result;
}

/// Fills in the members that follow from the order and the first columns.
void number(Supernodes& l)
{
    l.rank.resize(l.order.size());
    for (Index j = 0; j < l.size(); ++j) l.rank[l.order[j]] = j;
    l.supernode.resize(l.order.size());
    for (Index s = 0; s < l.count(); ++s)
        std::fill(l.supernode.begin() + l.first[s], l.supernode.begin() + l.first[s + 1], s);
}

Supernodes supernodes_of(const cholmod_factor& symbolic)
{
    const auto* const order = static_cast<const Index*>(symbolic.Perm);
    const auto* const first = static_cast<const Index*>(symbolic.super);
    const auto* const rows = static_cast<const Index*>(symbolic.s);
    const auto* const row_begin = static_cast<const Index*>(symbolic.pi);
    const auto* const value_begin = static_cast<const Index*>(symbolic.px);
    const std::size_t count = symbolic.nsuper;
    Supernodes result;
    result.order.assign(order, order + symbolic.n);
    result.first.assign(first, first + count + 1);
    result.rows.assign(rows, rows + row_begin[count]);
    result.row_begin.assign(row_begin, row_begin + count + 1);
    result.value_begin.assign(value_begin, value_begin + count + 1);
    number(result);
    return result;
}

/// Appends the ranks of the matrix row's entries that are `end` or above.
void append_ranks(const SparseMatrix& matrix, Index row, const std::vector<Index>& rank, Index end,
                  std::vector<Index>& ranks)
{
    for (SparseMatrix::InnerIterator it(matrix, row); it; ++it)
        if (rank[it.row()] >= end) ranks.push_back(rank[it.row()]);
}

/// @param order of the rows; empty: CHOLMOD finds one @param postorder whether CHOLMOD may change the order
Supernodes supernodes_in_order(const SparseMatrix& matrix, std::vector<Index> order, bool postorder,
                               CholmodCommon& common)
{
    cholmod_sparse lower = view(matrix, -1);
    common->nmethods = 1;
    common->method[0].ordering = order.empty() ? CHOLMOD_AMD : CHOLMOD_GIVEN;
    common->postorder = postorder ? 1 : 0;
    const Factor symbolic =
        own(cholmod_analyze_p(&lower, order.empty() ? nullptr : order.data(), nullptr, 0, common.get()), common);
    common.require(symbolic != nullptr, "symbolic analysis");
    return supernodes_of(*symbolic);
}

/// Rows with the same pattern are analyzed as one. That takes a third of the time for two coordinates of a vertex.
Supernodes supernodes_by_groups(const SparseMatrix& matrix)
{
    CholmodCommon common;
    const RowGroups groups = row_groups(matrix);
    if (groups.count() == matrix.rows()) return supernodes_in_order(matrix, {}, true, common);
    for (std::size_t& columns : common->nrelax) columns = columns * groups.count() / matrix.rows();
    Supernodes l = expanded(supernodes_in_order(pattern_of_groups(matrix, groups), {}, true, common), groups);
    number(l);
    return l;
}

/// @param last rows B that are kept to the end @param by_fill see analyze()
Supernodes supernodes_with_last(const SparseMatrix& matrix, const std::vector<Index>& last, bool by_fill)
{
    const auto ordered = [&](bool forced) {
        CholmodCommon common;
        std::vector<Index> order = by_fill && !forced ? elimination_order_by_fill(matrix, last, common)
                                                      : elimination_order(matrix, last, forced, common);
        return supernodes_in_order(matrix, std::move(order), !forced, common);
    };
    // CHOLMOD's own postorder keeps B last whenever the graph of A_II is connected. Otherwise order and postorder A_II
    // by itself and forbid any further change.
    Supernodes l = ordered(false);
    const Index inner_count = l.size() - static_cast<Index>(last.size());
    const auto is_last = [&](Index v) { return l.rank[v] >= inner_count; };
    return std::ranges::all_of(last, is_last) ? l : ordered(true);
}

class AnalysisInPieces {
public:
    AnalysisInPieces(const SparseMatrix& matrix, const std::vector<Index>& last) : matrix_(matrix), last_(last) {}

    Analysis run(const Dissection& dissection)
    {
        plant(dissection);
        number_tops();
        analyze_pieces();
        for (std::size_t p = result_.piece_count; p < parts_.size(); ++p) analyze_separator(parts_[p]);
        lay_out();
        number(l_);
        return std::move(result_);
    }

private:
    /// Builds the tree of the parts.
    void plant(const Dissection& dissection)
    {
        const std::vector<Dissection::Node>& nodes = dissection.nodes;
        std::vector<std::size_t> part_of(nodes.size()), depth(nodes.size(), 0);
        for (std::size_t i = nodes.size() - 1; i-- > 0;)
            depth[i] = depth[static_cast<std::size_t>(nodes[i].parent)] + 1;
        result_.rounds.resize(*std::max_element(depth.begin(), depth.end()));
        for (const bool piece : {true, false})
            for (std::size_t i = 0; i < nodes.size(); ++i)
                if (nodes[i].is_piece == piece) {
                    part_of[i] = rows_.size();
                    rows_.push_back(&nodes[i].rows);
                    if (piece)
                        ++result_.piece_count;
                    else
                        result_.rounds[result_.rounds.size() - 1 - depth[i]].push_back(part_of[i]);
                }
        parts_.resize(rows_.size());
        for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
            parts_[part_of[static_cast<std::size_t>(nodes[i].parent)]].children.push_back(part_of[i]);
        if (last_.empty()) return;
        result_.rounds.push_back({rows_.size()});
        parts_.emplace_back().children = {rows_.size() - 1};
        rows_.push_back(&last_);
    }

    /// Orders all rows that belong to no piece.
    void number_tops()
    {
        l_.order.resize(matrix_.rows());
        l_.rank.assign(matrix_.rows(), -1);
        Index row = 0;
        for (std::size_t p = 0; p < rows_.size(); ++p) {
            FactorPart& part = parts_[p];
            if (p == result_.piece_count) result_.tops = row;
            part.begin = row;
            row += static_cast<Index>(rows_[p]->size());
            part.end = row;
            if (p < result_.piece_count) continue;
            for (Index i = part.begin; i < part.end; ++i) {
                l_.order[i] = (*rows_[p])[i - part.begin];
                l_.rank[l_.order[i]] = i;
            }
        }
    }

    void analyze_pieces()
    {
        std::vector<Index> number(matrix_.rows());
        pieces_.resize(result_.piece_count);
        each_beside(pieces_.size(), [&](std::size_t p) {
            FactorPart& part = parts_[p];
            for (std::size_t i = 0; i < rows_[p]->size(); ++i) {
                const Index v = (*rows_[p])[i];
                number[v] = static_cast<Index>(i);
                append_ranks(matrix_, v, l_.rank, 0, part.interface);
            }
            sort_unique(part.interface);
            pieces_[p] = analyze_piece(matrix_, *rows_[p], part.interface, l_.rank, number);
            for (std::size_t i = 0; i < rows_[p]->size(); ++i) {
                const Index r = part.begin + static_cast<Index>(i);
                l_.order[r] = pieces_[p].order[i];
                l_.rank[l_.order[r]] = r;
            }
        });
    }

    void analyze_separator(FactorPart& part)
    {
        for (const std::size_t child : part.children)
            for (const Index r : parts_[child].interface)
                if (r >= part.end) part.interface.push_back(r);
        for (Index r = part.begin; r < part.end; ++r)
            append_ranks(matrix_, l_.order[r], l_.rank, part.end, part.interface);
        sort_unique(part.interface);
    }

    void lay_out()
    {
        for (std::size_t p = 0; p < parts_.size(); ++p) {
            FactorPart& part = parts_[p];
            const std::ptrdiff_t begin = static_cast<std::ptrdiff_t>(l_.rows.size());
            part.first_supernode = static_cast<Index>(l_.first.size());
            // A piece has supernodes of its own, a separator is one supernode.
            if (p < pieces_.size()) {
                const PieceSupernodes& piece = pieces_[p];
                const Index size = part.end - part.begin;
                for (std::size_t s = 0; s + 1 < piece.first.size(); ++s) {
                    l_.first.push_back(part.begin + piece.first[s]);
                    l_.row_begin.push_back(begin + piece.row_begin[s]);
                }
                for (const Index r : piece.rows)
                    l_.rows.push_back(r < size ? part.begin + r : part.interface[r - size]);
            } else if (part.end > part.begin) {
                l_.first.push_back(part.begin);
                l_.row_begin.push_back(begin);
                for (Index r = part.begin; r < part.end; ++r) l_.rows.push_back(r);
                l_.rows.insert(l_.rows.end(), part.interface.begin(), part.interface.end());
            }
            part.last_supernode = static_cast<Index>(l_.first.size());
        }
        l_.first.push_back(l_.size());
        l_.row_begin.push_back(static_cast<std::ptrdiff_t>(l_.rows.size()));
        l_.value_begin.assign(1, 0);
        for (Index s = 0; s < l_.count(); ++s)
            l_.value_begin.push_back(l_.value_begin.back() + static_cast<std::ptrdiff_t>(l_.width(s)) * l_.height(s));
    }

    const SparseMatrix& matrix_;
    const std::vector<Index>& last_;
    Analysis result_;
    Supernodes& l_ = result_.supernodes;
    std::vector<FactorPart>& parts_ = result_.parts;
    std::vector<const std::vector<Index>*> rows_;  // of each part
    std::vector<PieceSupernodes> pieces_;
};

}  // namespace

double Analysis::memory() const
{
    double numbers = static_cast<double>(supernodes.value_begin.back());
    for (std::size_t p = 0; p < piece_count; ++p)
        numbers += static_cast<double>(parts[p].interface.size()) * static_cast<double>(parts[p].interface.size());
    return sizeof(double) * numbers;
}

Analysis analyze(const SparseMatrix& matrix, const std::vector<Index>& last, bool by_fill)
{
    const ProfiledStage profiled("order");
    Analysis result;
    Supernodes& l = result.supernodes;
    l = last.empty() ? supernodes_by_groups(matrix) : supernodes_with_last(matrix, last, by_fill);
    result.tops = l.size();
    result.piece_count = 1;
    result.parts.push_back({0, l.size(), 0, l.count(), {}, {}});
    return result;
}

std::optional<Analysis> analyze_in_pieces(const SparseMatrix& matrix, const std::vector<Index>& last, Index piece_rows)
{
    const ProfiledStage profiled("order");
    const Dissection dissection = dissect(matrix, last, piece_rows);
    if (dissection.nodes.size() < 2) return std::nullopt;
    return AnalysisInPieces(matrix, last).run(dissection);
}

}  // namespace koebe::detail
