#include "fit/bounded_matches.h"

#include "core/errors.h"
#include "core/numbering.h"
#include "shape/separation_distance.h"

#include <algorithm>

namespace koebe {
namespace {

class BoundedSearch {
public:
    BoundedSearch(const std::vector<Circle>& a, const std::vector<Circle>& b, double limit,
                  const ExecutionContext& context)
        : a_(conformal_separations(a)),
          b_(conformal_separations(b)),
          limit_(limit),
          context_(context),
          match_(numbers_below(a.size()))
    {
    }

    std::vector<BoundedMatch> run()
    {
        go(1, 1.0);
        std::ranges::sort(found_);
        return std::move(found_);
    }

private:
    /// @param k loops have partners @param bound from these
    void go(std::size_t k, double bound)
    {
        constexpr std::size_t most_nodes = 2000000, most_found = 10000;
        if (++nodes_ > most_nodes || found_.size() > most_found) refuse_long_search();
        if (nodes_ % 1000 == 0) context_.checkpoint();
        if (k == match_.size()) {
            found_.emplace_back(bound, match_);
            return;
        }
        for (std::size_t i = k; i < match_.size(); ++i) {
            std::swap(match_[k], match_[i]);
            double least = bound;
            for (std::size_t j = 0; j < k; ++j) {
                const double ratio =
                    a_(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k)) / b_(match_[j], match_[k]);
                least = std::max({least, ratio, 1.0 / ratio});
            }
            if (least < limit_) go(k + 1, least);
            std::swap(match_[k], match_[i]);
        }
    }

    MatrixXd a_, b_;  // separations
    double limit_;
    const ExecutionContext& context_;
    std::vector<int> match_;
    std::size_t nodes_ = 0;
    std::vector<BoundedMatch> found_;
};

}  // namespace

void refuse_long_search()
{
    throw InputError("the loops are too many, or too much alike, for this search: give the match");
}

std::vector<BoundedMatch> bounded_matches(const std::vector<Circle>& a, const std::vector<Circle>& b, double limit,
                                          const ExecutionContext& context)
{
    return BoundedSearch(a, b, limit, context).run();
}

}  // namespace koebe
