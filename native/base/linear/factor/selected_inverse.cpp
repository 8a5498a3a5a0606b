#include "linear/factor/selected_inverse.h"

#include "execution/profile.h"
#include "execution/thread_share.h"
#include "linear/dense_blas.h"
#include "linear/factor/subtrees.h"

#include <algorithm>

namespace koebe::detail {
namespace {

/// The inverse on the pattern of some supernodes. Each has a block like its block in L: first the rows of its columns
/// J, lower triangle, then R.
class PatternInverse {
public:
    explicit PatternInverse(const SupernodalFactor& l) : l_(l), blocks_(l.count()) {}

    void compute(Index s)
    {
        const int width = l_.width(s), height = l_.height(s), below = height - width;
        const Index* rows = l_.rows_of(s) + width;
        MatrixXd& z = blocks_[s];
        z = Eigen::Map<const MatrixXd>(l_.values(s), height, width);
        const MatrixXd y = below_times_inverse(s);
        int info = 0;
        dpotri_("L", &width, z.data(), &height, &info);  // L_JJ^-T L_JJ^-1
        if (below == 0) return;

        MatrixXd corner(below, below);  // Z_RR, lower triangle
        std::vector<Index> place(below);
        for (int c = 0; c < below;) {
            // Rows of R that are columns of one supernode stand side by side.
            const Index owner = l_.supernode[rows[c]];
            int end = c;
            while (end < below && l_.supernode[rows[end]] == owner) ++end;
            locate(owner, rows, c, place);
            for (int column = c; column < end; ++column) {
                const double* from = &blocks_[owner](0, rows[column] - l_.first[owner]);
                for (int r = column; r < below; ++r) corner(r, column) = from[place[r]];
            }
            c = end;
        }
        const double one = 1.0, minus_one = -1.0, zero = 0.0;
        double* lower_part = z.data() + width;
        dsymm_("L", "L", &below, &width, &minus_one, corner.data(), &below, y.data(), &below, &zero, lower_part,
               &height);
        dgemm_("T", "N", &width, &width, &below, &minus_one, y.data(), &below, lower_part, &height, &one, z.data(),
               &height);
    }

    /// The entry at two rows of L; row is not above column.
    double entry(Index row, Index column) const
    {
        const Index s = l_.supernode[column];
        const Index* rows = l_.rows_of(s);
        return blocks_[s](std::lower_bound(rows, rows + l_.height(s), row) - rows, column - l_.first[s]);
    }

private:
    /// L_RJ L_JJ^-1.
    MatrixXd below_times_inverse(Index s) const
    {
        const int width = l_.width(s), height = l_.height(s), below = height - width;
        MatrixXd y = Eigen::Map<const MatrixXd>(l_.values(s), height, width).bottomRows(below);
        const double one = 1.0;
        if (below > 0) dtrsm_("R", "L", "N", "N", &below, &width, &one, l_.values(s), &height, y.data(), &below);
        return y;
    }

    /// The places of the rows from number `first` on among a supernode's rows; both ascend.
    void locate(Index owner, const Index* rows, int first, std::vector<Index>& place) const
    {
        const Index* among = l_.rows_of(owner);
        Index at = 0;
        for (std::size_t r = first; r < place.size(); ++r) {
            while (among[at] != rows[r]) ++at;
            place[r] = at;
        }
    }

    const SupernodalFactor& l_;
    std::vector<MatrixXd> blocks_;
};

}  // namespace

std::vector<MatrixXd> selected_inverse(const SupernodalFactor& l, const std::vector<std::vector<Index>>& sets)
{
    const ProfiledStage profiled("invert");
    std::vector<char> needed(l.count(), 0);
    for (const std::vector<Index>& set : sets)
        for (const Index v : set)
            for (Index s = l.supernode[l.rank[v]]; !needed[s]; s = l.parent(s)) needed[s] = 1;
    PatternInverse inverse(l);
    Subtrees(l, needed).downward([&](const std::vector<Index>& supernodes) {
        std::for_each(supernodes.rbegin(), supernodes.rend(), [&](Index s) { inverse.compute(s); });
    });

    std::vector<MatrixXd> result(sets.size());
    each_beside(sets.size(), [&](std::size_t k) {
        const std::vector<Index>& set = sets[k];
        MatrixXd& block = result[k];
        block.resize(static_cast<Eigen::Index>(set.size()), static_cast<Eigen::Index>(set.size()));
        for (std::size_t i = 0; i < set.size(); ++i)
            for (std::size_t j = 0; j <= i; ++j) {
                const Index p = l.rank[set[i]], q = l.rank[set[j]];
                block(i, j) = block(j, i) = inverse.entry(std::max(p, q), std::min(p, q));
            }
    });
    return result;
}

}  // namespace koebe::detail
