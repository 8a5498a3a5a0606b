#include "linear/split_factor.h"

#include "core/thread_share.h"
#include "linear/dissection.h"
#include "linear/front.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace koebe::detail {
namespace {

/// Appends the rows at or above `end` that a row of the matrix has an entry in.
void append_ranks(const SparseMatrix& matrix, Index row, const std::vector<Index>& rank, Index end,
                  std::vector<Index>& ranks)
{
    for (SparseMatrix::InnerIterator it(matrix, row); it; ++it)
        if (rank[it.row()] >= end) ranks.push_back(rank[it.row()]);
}

void sort_unique(std::vector<Index>& numbers)
{
    std::sort(numbers.begin(), numbers.end());
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace

std::unique_ptr<SplitFactor> SplitFactor::analyze(const SparseMatrix& matrix, const std::vector<Index>& last,
                                                  Index piece_rows)
{
    const Dissection dissection = dissect(matrix, last, piece_rows);
    if (dissection.nodes.size() < 2) return {};
    auto result = std::make_unique<SplitFactor>();
    std::vector<const std::vector<Index>*> rows;
    std::vector<std::size_t> part_of(dissection.nodes.size()), depth(dissection.nodes.size(), 0);
    for (std::size_t i = dissection.nodes.size() - 1; i-- > 0;)
        depth[i] = depth[static_cast<std::size_t>(dissection.nodes[i].parent)] + 1;
    result->rounds_.resize(*std::max_element(depth.begin(), depth.end()));
    for (const bool piece : {true, false})
        for (std::size_t i = 0; i < dissection.nodes.size(); ++i)
            if (dissection.nodes[i].is_piece == piece) {
                part_of[i] = rows.size();
                rows.push_back(&dissection.nodes[i].rows);
                if (piece)
                    ++result->piece_count_;
                else
                    result->rounds_[result->rounds_.size() - 1 - depth[i]].push_back(part_of[i]);
            }
    result->parts_.resize(rows.size());
    for (std::size_t i = 0; i + 1 < dissection.nodes.size(); ++i)
        result->parts_[part_of[static_cast<std::size_t>(dissection.nodes[i].parent)]].children.push_back(part_of[i]);
    if (!last.empty()) {
        result->rounds_.push_back({rows.size()});
        result->parts_.emplace_back().children = {rows.size() - 1};
        rows.push_back(&last);
    }

    SupernodeLayout& layout = result->layout_;
    layout.order.resize(matrix.rows());
    layout.rank.assign(matrix.rows(), -1);
    Index row = 0;
    for (std::size_t p = 0; p < rows.size(); ++p) {
        SplitPart& part = result->parts_[p];
        if (p == result->piece_count_) result->tops_ = row;
        part.begin = row;
        row += static_cast<Index>(rows[p]->size());
        part.end = row;
        if (p < result->piece_count_) continue;
        for (Index i = part.begin; i < part.end; ++i) {
            layout.order[i] = (*rows[p])[i - part.begin];
            layout.rank[layout.order[i]] = i;
        }
    }
    result->analyze_pieces(matrix, rows);
    return result;
}

void SplitFactor::analyze_pieces(const SparseMatrix& matrix, const std::vector<const std::vector<Index>*>& rows)
{
    std::vector<Index> number(matrix.rows());
    std::vector<PieceSupernodes> pieces(piece_count_);
    each_beside(piece_count_, [&](std::size_t p) {
        SplitPart& part = parts_[p];
        for (std::size_t i = 0; i < rows[p]->size(); ++i) {
            const Index v = (*rows[p])[i];
            number[v] = static_cast<Index>(i);
            append_ranks(matrix, v, layout_.rank, 0, part.interface);
        }
        sort_unique(part.interface);
        pieces[p] = analyze_piece(matrix, *rows[p], part.interface, layout_.rank, number);
        for (std::size_t i = 0; i < rows[p]->size(); ++i) {
            const Index r = part.begin + static_cast<Index>(i);
            layout_.order[r] = pieces[p].order[i];
            layout_.rank[layout_.order[r]] = r;
        }
    });
    for (std::size_t p = piece_count_; p < parts_.size(); ++p) analyze_separator(matrix, parts_[p]);
    lay_out(pieces);
}

void SplitFactor::analyze_separator(const SparseMatrix& matrix, SplitPart& part)
{
    for (const std::size_t child : part.children)
        for (const Index r : parts_[child].interface)
            if (r >= part.end) part.interface.push_back(r);
    for (Index r = part.begin; r < part.end; ++r)
        append_ranks(matrix, layout_.order[r], layout_.rank, part.end, part.interface);
    sort_unique(part.interface);
}

void SplitFactor::lay_out(const std::vector<PieceSupernodes>& pieces)
{
    SupernodeLayout& l = layout_;
    Index count = 0;
    std::ptrdiff_t row_count = 0;
    for (std::size_t p = 0; p < parts_.size(); ++p) {
        SplitPart& part = parts_[p];
        part.first_supernode = count;
        if (p < piece_count_) {
            count += static_cast<Index>(pieces[p].first.size()) - 1;
            row_count += static_cast<std::ptrdiff_t>(pieces[p].rows.size());
        } else if (part.end > part.begin) {
            ++count;
            row_count += part.end - part.begin + static_cast<std::ptrdiff_t>(part.interface.size());
        }
        part.last_supernode = count;
    }
    l.first.reserve(count + 1);
    l.row_begin.reserve(count + 1);
    l.rows.reserve(row_count);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
        const SplitPart& part = parts_[p];
        const std::ptrdiff_t begin = static_cast<std::ptrdiff_t>(l.rows.size());
        if (p < piece_count_) {
            const Index size = part.end - part.begin;
            for (std::size_t s = 0; s + 1 < pieces[p].first.size(); ++s) {
                l.first.push_back(part.begin + pieces[p].first[s]);
                l.row_begin.push_back(begin + pieces[p].row_begin[s]);
            }
            for (const Index r : pieces[p].rows) l.rows.push_back(r < size ? part.begin + r : part.interface[r - size]);
        } else if (part.end > part.begin) {
            l.first.push_back(part.begin);
            l.row_begin.push_back(begin);
            for (Index r = part.begin; r < part.end; ++r) l.rows.push_back(r);
            l.rows.insert(l.rows.end(), part.interface.begin(), part.interface.end());
        }
    }
    l.first.push_back(static_cast<Index>(l.order.size()));
    l.row_begin.push_back(static_cast<std::ptrdiff_t>(l.rows.size()));
    l.value_begin.assign(1, 0);
    l.value_begin.reserve(count + 1);
    for (Index s = 0; s < count; ++s)
        l.value_begin.push_back(l.value_begin.back() + static_cast<std::ptrdiff_t>(l.width(s)) * l.height(s));
}

double SplitFactor::memory() const
{
    double numbers = static_cast<double>(layout_.value_begin.back());
    for (std::size_t p = 0; p < piece_count_; ++p)
        numbers += static_cast<double>(parts_[p].interface.size()) * static_cast<double>(parts_[p].interface.size());
    return sizeof(double) * numbers;
}

void SplitFactor::factorize(const SparseMatrix& matrix)
{
    if (!values_.data()) values_ = LargeArray(static_cast<std::size_t>(layout_.value_begin.back()));
    RestPool pool;
    std::vector<LowerMatrix> rests(parts_.size());
    each_beside(piece_count_, [&](std::size_t p) {
        rests[p] = pool.take(static_cast<Index>(parts_[p].interface.size()));
        factorize_piece(matrix, layout_, parts_[p], tops_, values_.data(), rests[p]);
    });
    constexpr std::size_t few = 2;  // are taken one after the other, on all threads each
    for (const std::vector<std::size_t>& round : rounds_)
        if (round.size() > few)
            each_beside(round.size(),
                        [&](std::size_t i) { factorize_separator(matrix, parts_[round[i]], rests, pool); });
        else
            for (const std::size_t p : round) factorize_separator(matrix, parts_[p], rests, pool);
}

void SplitFactor::factorize_separator(const SparseMatrix& matrix, const SplitPart& part,
                                      std::vector<LowerMatrix>& rests, RestPool& pool)
{
    const Index width = part.end - part.begin, others = static_cast<Index>(part.interface.size());
    const Index height = width + others;
    std::vector<Index> place(layout_.order.size() - tops_);
    for (Index r = 0; r < width; ++r) place[part.begin + r - tops_] = r;
    for (Index r = 0; r < others; ++r) place[part.interface[r] - tops_] = width + r;
    double* block = width > 0 ? values_.data() + layout_.value_begin[part.first_supernode] : nullptr;
    LowerMatrix rest = pool.take(others);
    std::fill(block, block + static_cast<std::ptrdiff_t>(width) * height, 0.0);
    for (Index c = 0; c < width; ++c)
        for (SparseMatrix::InnerIterator it(matrix, layout_.order[part.begin + c]); it; ++it)
            if (const Index r = layout_.rank[it.row()]; r >= part.begin + c)
                block[place[r - tops_] + static_cast<std::ptrdiff_t>(c) * height] = it.value();
    for (const std::size_t child : part.children) {
        LowerMatrix from = std::exchange(rests[child], {});
        const std::vector<Index>& rows = parts_[child].interface;
        in_pieces(rows.size(), 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t c = begin; c < end; ++c) {
                const Index column = place[rows[c] - tops_];
                double* to = column < width ? block + static_cast<std::ptrdiff_t>(column) * height
                                            : rest.column(column - width) - width;
                const double* numbers = from.column(static_cast<Index>(c));
                for (std::size_t r = c; r < rows.size(); ++r) to[place[rows[r] - tops_]] += numbers[r];
            }
        });
        pool.give_back(std::move(from));
    }
    eliminate(block, height, width, rest.numbers.data());
    rests[&part - parts_.data()] = std::move(rest);
}

void SplitFactor::solve_lower(MatrixXd& x) const
{
    const Index count = static_cast<Index>(x.cols()), top_count = static_cast<Index>(layout_.order.size()) - tops_;
    std::vector<MatrixXd> arrived(piece_count_);
    each_beside(piece_count_, [&](std::size_t p) {
        arrived[p] = MatrixXd::Zero(top_count, count);
        solve_lower(parts_[p], x, arrived[p]);
    });
    for (std::size_t p = 0; p < piece_count_; ++p)
        for (const Index r : parts_[p].interface) x.row(r) += arrived[p].row(r - tops_);
    MatrixXd top = MatrixXd::Zero(top_count, count);
    for (std::size_t p = piece_count_; p < parts_.size(); ++p) {
        x.middleRows(parts_[p].begin, parts_[p].end - parts_[p].begin) +=
            top.middleRows(parts_[p].begin - tops_, parts_[p].end - parts_[p].begin);
        solve_lower(parts_[p], x, top);
    }
}

void SplitFactor::solve_lower(const SplitPart& part, MatrixXd& x, MatrixXd& interface) const
{
    MatrixXd update;
    for (Index s = part.first_supernode; s < part.last_supernode; ++s) {
        const Index width = layout_.width(s);
        substitute_forward(values_.data() + layout_.value_begin[s], layout_.height(s), width, layout_.first[s], x,
                           update);
        const Index* rows = layout_.rows_of(s) + width;
        for (Index r = 0; r < static_cast<Index>(update.rows()); ++r)
            if (rows[r] < part.end)
                x.row(rows[r]) += update.row(r);
            else
                interface.row(rows[r] - tops_) += update.row(r);
    }
}

void SplitFactor::solve_upper(MatrixXd& x) const
{
    for (std::size_t p = parts_.size(); p-- > piece_count_;) solve_upper(parts_[p], x);
    each_beside(piece_count_, [&](std::size_t p) { solve_upper(parts_[p], x); });
}

void SplitFactor::solve_upper(const SplitPart& part, MatrixXd& x) const
{
    for (Index s = part.last_supernode; s-- > part.first_supernode;)
        substitute_backward(values_.data() + layout_.value_begin[s], layout_.height(s), layout_.width(s),
                            layout_.first[s], layout_.rows_of(s) + layout_.width(s), x);
}

}  // namespace koebe::detail
