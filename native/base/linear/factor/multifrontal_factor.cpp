#include "linear/factor/multifrontal_factor.h"

#include "core/errors.h"
#include "execution/memory_limit.h"
#include "execution/profile.h"
#include "linear/dense_blas.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

namespace koebe::detail {
namespace {

constexpr int narrow = 4;  // columns; up to here loops are faster than calls of the dense kernels

[[noreturn]] void not_positive() { throw SolverError("sparse factorization: matrix not positive definite"); }

/// Eliminates the first columns of a front by loops.
void eliminate_narrow(double* columns, int width, int height, MatrixXd& left)
{
    for (int j = 0; j < width; ++j) {
        double* column = columns + static_cast<std::ptrdiff_t>(j) * height;
        if (!(column[j] > 0.0)) not_positive();
        const double pivot = std::sqrt(column[j]);
        column[j] = pivot;
        const double inverse = 1.0 / pivot;
        for (int r = j + 1; r < height; ++r) column[r] *= inverse;
        for (int c = j + 1; c < width; ++c) {
            double* other = columns + static_cast<std::ptrdiff_t>(c) * height;
            const double factor = column[c];
            for (int r = c; r < height; ++r) other[r] -= factor * column[r];
        }
    }
    const int below = height - width;
    for (int j = 0; j < width; ++j) {
        const double* column = columns + static_cast<std::ptrdiff_t>(j) * height + width;
        for (int c = 0; c < below; ++c) {
            double* other = &left(0, c);
            const double factor = column[c];
            for (int r = c; r < below; ++r) other[r] -= factor * column[r];
        }
    }
}

void eliminate_wide(double* columns, int width, int height, MatrixXd& left)
{
    int info = 0;
    dpotrf_("L", &width, columns, &height, &info);
    if (info != 0) not_positive();
    const int below = height - width;
    if (below == 0) return;
    const double one = 1.0, minus_one = -1.0;
    dtrsm_("R", "L", "T", "N", &below, &width, &one, columns, &height, columns + width, &height);
    dsyrk_("L", "N", &below, &width, &minus_one, columns + width, &height, &one, left.data(), &below);
}

/// The lower triangle of a matrix in the factor's order, column by column.
class ColumnsInOrder {
public:
    ColumnsInOrder(const Supernodes& l, const SparseMatrix& matrix)
        : l_(l), begin_(l.size() + 1, 0), entries_(matrix.nonZeros())
    {
        each_entry(matrix, [&](Index column, Index, double) { ++begin_[column + 1]; });
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        std::vector<Index> end(begin_.begin(), begin_.end() - 1);
        each_entry(matrix, [&](Index column, Index row, double value) { entries_[end[column]++] = {row, value}; });
    }

    /// The columns of a supernode, (height, width). @param place scratch, one number per row of the matrix
    void assemble(Index s, double* columns, Index* place) const
    {
        const std::ptrdiff_t height = l_.height(s), width = l_.width(s);
        std::fill_n(columns, height * width, 0.0);
        for (Index r = 0; r < height; ++r) place[l_.rows_of(s)[r]] = r;
        for (std::ptrdiff_t j = 0; j < width; ++j) {
            const Index column = l_.first[s] + static_cast<Index>(j);
            for (Index e = begin_[column]; e < begin_[column + 1]; ++e)
                columns[j * height + place[entries_[e].row]] = entries_[e].value;
        }
    }

private:
    struct Entry {
        Index row;
        double value;
    };

    template <typename Visit>
    void each_entry(const SparseMatrix& matrix, const Visit& visit) const
    {
        for (Index c = 0; c < static_cast<Index>(matrix.cols()); ++c)
            for (SparseMatrix::InnerIterator it(matrix, c); it; ++it) {
                if (it.row() < c) continue;
                const auto [column, row] = std::minmax(l_.rank[it.row()], l_.rank[c]);
                visit(column, row, it.value());
            }
    }

    const Supernodes& l_;
    std::vector<Index> begin_;
    std::vector<Entry> entries_;
};

}  // namespace

MultifrontalFactor::MultifrontalFactor(SupernodalFactor& l, const SparseMatrix& matrix,
                                       const std::vector<std::vector<Index>>& changing)
    : l_(l)
{
    const Index count = l_.count();
    changes_.assign(count, 0);
    for (const std::vector<Index>& set : changing)
        for (const Index v : set)
            for (Index s = l_.supernode[l_.rank[v]]; !changes_[s]; s = l_.parent(s)) changes_[s] = 1;
    // An entry changes the supernode of its row and all on the way up to the root.
    changing_ = Subtrees(l_, changes_);
    all_ = Subtrees(l_, std::vector<char>(count, 1));
    double kept = 0.0;
    for (Index s = 0; s < count; ++s)
        if (changes_[s]) kept += l_.height(s) * l_.width(s) + std::pow(l_.height(s) - l_.width(s), 2);
    require_memory(8.0 * kept, "what is kept of the factorization");
    // Extend-add: where the rows that a child leaves stand among the rows of its parent.
    children_.resize(count);
    place_.resize(count);
    left_.resize(count);
    kept_columns_.resize(count);
    kept_left_.resize(count);
    addends_.resize(count);
    for (Index s = 0; s < count; ++s) {
        const Index parent = l_.parent(s);
        if (parent == s) continue;
        children_[parent].push_back(s);
        const Index* among = l_.rows_of(parent);
        const Index* row = l_.rows_of(s) + l_.width(s);
        Index at = 0;
        for (Index r = l_.width(s); r < l_.height(s); ++r, ++row) {
            while (among[at] != *row) ++at;
            place_[s].push_back(at);
        }
    }
    find_addends(changing);
    take(matrix);
}

void MultifrontalFactor::take(const SparseMatrix& matrix)
{
    const ColumnsInOrder in_order(l_, matrix);
    all_.upward([&](const std::vector<Index>& supernodes) {
        const auto place = std::make_unique_for_overwrite<Index[]>(l_.size());
        for (const Index s : supernodes) {
            in_order.assemble(s, l_.values(s), place.get());
            const Index below = l_.height(s) - l_.width(s);
            left_[s] = MatrixXd::Zero(below, below);
            add_children(s, false);
            if (changes_[s]) {
                kept_columns_[s] = Eigen::Map<const MatrixXd>(l_.values(s), l_.height(s), l_.width(s));
                kept_left_[s] = std::move(left_[s]);
            } else {
                eliminate(s);
            }
        }
    });
}

void MultifrontalFactor::find_addends(const std::vector<std::vector<Index>>& changing)
{
    for (std::size_t k = 0; k < changing.size(); ++k)
        for (std::size_t c = 0; c < changing[k].size(); ++c)
            for (std::size_t r = c; r < changing[k].size(); ++r) {
                const auto [low, high] = std::minmax(l_.rank[changing[k][r]], l_.rank[changing[k][c]]);
                const Index s = l_.supernode[low];
                const Index* rows = l_.rows_of(s);
                const std::ptrdiff_t at = std::lower_bound(rows, rows + l_.height(s), high) - rows;
                addends_[s].push_back({static_cast<Index>(k), static_cast<Index>(r), static_cast<Index>(c),
                                       at + static_cast<std::ptrdiff_t>(low - l_.first[s]) * l_.height(s)});
            }
}

/// Adds to the front the updates of the children that change, or of those that do not.
void MultifrontalFactor::add_children(Index s, bool changing)
{
    const int width = l_.width(s);
    const std::ptrdiff_t height = l_.height(s);
    for (const Index child : children_[s]) {
        if (static_cast<bool>(changes_[child]) != changing) continue;
        const std::vector<Index>& place = place_[child];
        const MatrixXd& from = left_[child];
        const int count = static_cast<int>(place.size());
        for (int c = 0; c < count; ++c) {
            double* to = place[c] < width ? l_.values(s) + place[c] * height : &left_[s](0, place[c] - width) - width;
            const double* column = &from(0, c);
            for (int r = c; r < count; ++r) to[place[r]] += column[r];
        }
        left_[child].resize(0, 0);
    }
}

void MultifrontalFactor::eliminate(Index s)
{
    const int width = l_.width(s), height = l_.height(s);
    if (width <= narrow)
        eliminate_narrow(l_.values(s), width, height, left_[s]);
    else
        eliminate_wide(l_.values(s), width, height, left_[s]);
}

void MultifrontalFactor::refactorize(const std::vector<MatrixXd>& blocks)
{
    const ProfiledStage profiled("eliminate");
    changing_.upward([&](const std::vector<Index>& supernodes) {
        for (const Index s : supernodes) {
            std::copy_n(kept_columns_[s].data(), kept_columns_[s].size(), l_.values(s));
            left_[s] = kept_left_[s];
            for (const Addend& a : addends_[s]) l_.values(s)[a.place] += blocks[a.set](a.row, a.column);
            add_children(s, true);
            eliminate(s);
        }
    });
}

}  // namespace koebe::detail
