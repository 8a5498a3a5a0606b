#include "linear/factor/piece_factor.h"

#include "core/errors.h"
#include "linear/dense_blas.h"

#include <algorithm>
#include <cstdint>

namespace koebe::detail {
namespace {

class PieceFactorization {
public:
    PieceFactorization(const SparseMatrix& matrix, const DiagonalShift& shift, const Supernodes& l,
                       const FactorPart& part, Index tops, double* values, const LowerMatrix& rest,
                       const MatrixPlaces* places)
        : matrix_(matrix),
          shift_(shift),
          places_(places),
          l_(l),
          part_(part),
          tops_(tops),
          values_(values),
          rest_(rest),
          size_(part.end - part.begin),
          count_(part.last_supernode - part.first_supernode),
          waiting_(count_, -1),
          next_(count_, -1),
          done_rows_(count_, 0),
          owner_(size_),
          place_(size_ + l.rank.size() - tops),
          number_(l.rank.size() - tops)
    {
        for (Index s = 0; s < count_; ++s)
            std::fill(owner_.begin() + l.first[part.first_supernode + s] - part.begin,
                      owner_.begin() + l.first[part.first_supernode + s + 1] - part.begin, s);
        for (std::size_t i = 0; i < part.interface.size(); ++i)
            number_[part.interface[i] - tops] = static_cast<Index>(i);
    }

    void run()
    {
        for (Index s = 0; s < count_; ++s) {
            gather(s);
            for (Index d = waiting_[s]; d >= 0;) {
                const Index following = next_[d];
                subtract(d, s);
                wait(d);
                d = following;
            }
            eliminate_columns(s);
            done_rows_[s] = width(s);
            wait(s);
            subtract_from_interface(s);
        }
    }

private:
    Index first(Index s) const { return l_.first[part_.first_supernode + s]; }
    int width(Index s) const { return l_.width(part_.first_supernode + s); }
    int height(Index s) const { return l_.height(part_.first_supernode + s); }
    const Index* rows(Index s) const { return l_.rows_of(part_.first_supernode + s); }
    double* block(Index s) const { return values_ + l_.value_begin[part_.first_supernode + s]; }
    Index& place(Index row) { return place_[row < part_.end ? row - part_.begin : size_ + row - tops_]; }

    double* room(std::size_t numbers)
    {
        if (room_ < numbers) {
            const std::size_t room = numbers + numbers / 2;
            work_ = LargeArray(room);  // Eigen's resize() would free the old memory twice when memory runs out
            room_ = room;
        }
        return work_.data();
    }

    /// Gathers the matrix's own entries.
    void gather(Index s)
    {
        const int w = width(s), h = height(s);
        double* to = block(s);
        std::fill(to, to + static_cast<std::ptrdiff_t>(w) * h, 0.0);
        for (Index r = 0; r < h; ++r) place(rows(s)[r]) = r;
        if (places_) {
            for (Index e = places_->begin[s]; e < places_->begin[s + 1]; ++e)
                to[places_->place[e]] = matrix_.valuePtr()[places_->entry[e]];
        } else {
            for (Index c = 0; c < w; ++c)
                for (SparseMatrix::InnerIterator it(matrix_, l_.order[first(s) + c]); it; ++it)
                    if (const Index row = l_.rank[it.row()]; row >= first(s) + c)
                        to[place(row) + static_cast<std::ptrdiff_t>(c) * h] = it.value();
        }
        for (Index c = std::max(shift_.first - first(s), 0); c < w; ++c)
            to[c + static_cast<std::ptrdiff_t>(c) * h] += shift_.number;
    }

    /// Subtracts the contribution of an earlier supernode to these columns.
    void subtract(Index d, Index s)
    {
        const Index* from = rows(d) + done_rows_[d];
        const Index end = first(s) + width(s);
        const int m = height(d) - done_rows_[d], k = width(d), stride = height(d), h = height(s);
        int n = 1;
        while (n < m && from[n] < end) ++n;
        double* product = room(static_cast<std::size_t>(m) * n);
        multiply(m, n, k, block(d) + done_rows_[d], stride, product);
        targets_.resize(m);
        for (int r = 0; r < m; ++r) targets_[r] = place(from[r]);
        double* to = block(s);
        for (int c = 0; c < n; ++c) {
            double* column = to + static_cast<std::ptrdiff_t>(from[c] - first(s)) * h;
            const double* taken = product + static_cast<std::ptrdiff_t>(c) * m;
            for (int r = c; r < m; ++r) column[targets_[r]] -= taken[r];
        }
        done_rows_[d] += n;
    }

    /// A B' as lower_product does it. Loops handle small products, where a call costs too much.
    static void multiply(int m, int n, int k, const double* a, int stride, double* product)
    {
        constexpr std::int64_t small = 1024;  // products
        if (std::int64_t{m} * n * k > small) {
            lower_product(m, n, k, 1.0, a, stride, 0.0, product, m);
            return;
        }
        for (int c = 0; c < n; ++c) {
            double* column = product + static_cast<std::ptrdiff_t>(c) * m;
            for (int r = c; r < m; ++r) column[r] = a[r] * a[c];
            for (int p = 1; p < k; ++p) {
                const double* factor = a + static_cast<std::ptrdiff_t>(p) * stride;
                for (int r = c; r < m; ++r) column[r] += factor[r] * factor[c];
            }
        }
    }

    void eliminate_columns(Index s)
    {
        const int w = width(s), h = height(s), below = h - w;
        int info = 0;
        dpotrf_("L", &w, block(s), &h, &info);
        if (info != 0) throw SolverError("sparse factorization: the matrix is not positive definite");
        const double one = 1.0;
        if (below > 0) dtrsm_("R", "L", "T", "N", &below, &w, &one, block(s), &h, block(s) + w, &h);
    }

    /// Puts a supernode on the list of the next supernode in which it has rows.
    void wait(Index s)
    {
        if (done_rows_[s] == height(s) || rows(s)[done_rows_[s]] >= part_.end) return;
        const Index target = owner_[rows(s)[done_rows_[s]] - part_.begin];
        next_[s] = waiting_[target];
        waiting_[target] = s;
    }

    void subtract_from_interface(Index s)
    {
        const Index* const all = rows(s);
        const Index from = static_cast<Index>(std::lower_bound(all + width(s), all + height(s), part_.end) - all);
        const int n = height(s) - from;
        if (n == 0) return;
        double* product = room(static_cast<std::size_t>(n) * n);
        multiply(n, n, width(s), block(s) + from, height(s), product);
        targets_.resize(n);
        for (int r = 0; r < n; ++r) targets_[r] = number_[all[from + r] - tops_];
        for (int c = 0; c < n; ++c) {
            double* column = rest_.column(targets_[c]);
            const double* taken = product + static_cast<std::ptrdiff_t>(c) * n;
            for (int r = c; r < n; ++r) column[targets_[r]] -= taken[r];
        }
    }

    const SparseMatrix& matrix_;
    const DiagonalShift& shift_;
    const MatrixPlaces* places_;
    const Supernodes& l_;
    const FactorPart& part_;
    Index tops_;
    double* values_;
    const LowerMatrix& rest_;
    Index size_, count_;
    std::vector<Index> waiting_, next_;  // lists of supernodes: the first entry of each list, and the entry after each
    std::vector<Index> done_rows_;       // per supernode: its rows whose contributions are already subtracted
    std::vector<Index> owner_;           // supernode of each column
    std::vector<Index> place_;           // place of a row in the current block
    std::vector<Index> number_;          // number of a row in the interface
    std::vector<Index> targets_;
    LargeArray work_;
    std::size_t room_ = 0;
};

}  // namespace

void factorize_piece(const SparseMatrix& matrix, const DiagonalShift& shift, const Supernodes& l,
                     const FactorPart& part, Index tops, double* values, const LowerMatrix& rest,
                     const MatrixPlaces* places)
{
    PieceFactorization(matrix, shift, l, part, tops, values, rest, places).run();
}

}  // namespace koebe::detail
