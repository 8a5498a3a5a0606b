#include "shape/separation_distance.h"

#include "core/errors.h"
#include "core/numbering.h"
#include "shape/conformal_module.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace koebe {
namespace {

constexpr long most_partners_tried = 4'000'000;  // seconds
constexpr long partners_a_check = 4096;

void require_same_count(const std::vector<Circle>& a, const std::vector<Circle>& b)
{
    if (a.size() != b.size())
        throw InputError("the domains have " + std::to_string(a.size()) + " and " + std::to_string(b.size()) +
                         " loops: their separations cannot be compared");
}

/// Root of the mean over all pairs.
double root_mean(double sum, Eigen::Index loops)
{
    const double pairs = 0.5 * static_cast<double>(loops * (loops - 1));
    return pairs > 0.0 ? std::sqrt(sum / pairs) : 0.0;
}

class MatchSearch {
public:
    MatchSearch(MatrixXd a, MatrixXd b, bool any_outer, const ExecutionContext& context)
        : a_(std::move(a)),
          b_(std::move(b)),
          any_outer_(any_outer),
          context_(context),
          order_(numbers_below(a_.rows())),
          used_(a_.rows())
    {
        // Loops with the largest separations tell most: they come first, behind the outer loop.
        std::stable_sort(order_.begin() + 1, order_.end(),
                         [&](int i, int j) { return a_.row(i).sum() > a_.row(j).sum(); });
    }

    SeparationMatch search()
    {
        chosen_.assign(order_.size(), -1);
        extend(0, 0.0, MatrixXd::Zero(a_.rows(), a_.cols()));
        return {std::move(best_), root_mean(least_, a_.rows())};
    }

private:
    /// @param sum over the pairs of the loops before @param cost (L, L) what a loop of a with a partner adds to it
    void extend(std::size_t depth, double sum, const MatrixXd& cost)
    {
        if (depth == order_.size()) {
            least_ = sum;
            best_.assign(order_.size(), -1);
            for (std::size_t i = 0; i < order_.size(); ++i) best_[order_[i]] = chosen_[i];
            return;
        }
        const int loop = order_[depth];
        std::vector<std::pair<double, int>> partners;
        for (int k = 0; k < static_cast<int>(used_.size()); ++k)
            if (!used_[k] && (any_outer_ || (k == 0) == (depth == 0))) partners.emplace_back(cost(loop, k), k);
        std::ranges::sort(partners);
        for (const auto& [more, k] : partners) {
            if (!(sum + more < least_)) return;
            if (++tried_ % partners_a_check == 0) context_.checkpoint();
            if (tried_ > most_partners_tried)
                throw InputError("the loops are too many, or too much alike, for this search: give the match");
            used_[k] = 1;
            chosen_[depth] = k;
            const MatrixXd next =
                cost + (a_.col(loop).replicate(1, b_.cols()) - b_.row(k).replicate(a_.rows(), 1)).cwiseAbs2();
            if (sum + more + least_of_the_rest(depth + 1, next) < least_) extend(depth + 1, sum + more, next);
            used_[k] = 0;
        }
    }

    /// A bound: each loop that has no partner yet costs at least as much as with the best one for itself.
    double least_of_the_rest(std::size_t depth, const MatrixXd& cost) const
    {
        double sum = 0.0;
        for (std::size_t i = depth; i < order_.size(); ++i) {
            double best = std::numeric_limits<double>::infinity();
            for (std::size_t k = 0; k < used_.size(); ++k)
                if (!used_[k]) best = std::min(best, cost(order_[i], static_cast<Eigen::Index>(k)));
            sum += best;
        }
        return sum;
    }

    MatrixXd a_, b_;
    bool any_outer_;
    const ExecutionContext& context_;
    std::vector<int> order_;   // of a's loops in the search
    std::vector<int> chosen_;  // b's loop for each of these
    std::vector<char> used_;   // of b's loops
    std::vector<int> best_;    // b's loop for each of a's
    double least_ = std::numeric_limits<double>::infinity();
    long tried_ = 0;
};

}  // namespace

MatrixXd conformal_separations(const std::vector<Circle>& circles)
{
    require_circle_domain(circles);
    const auto count = static_cast<Eigen::Index>(circles.size());
    MatrixXd all = MatrixXd::Zero(count, count);
    for (Eigen::Index i = 0; i < count; ++i)
        for (Eigen::Index j = 0; j < i; ++j) all(i, j) = all(j, i) = conformal_separation(circles[i], circles[j]);
    return all;
}

SeparationMatch match_separations(const std::vector<Circle>& a, const std::vector<Circle>& b, bool any_outer,
                                  const ExecutionContext& context)
{
    require_same_count(a, b);
    return MatchSearch(conformal_separations(a), conformal_separations(b), any_outer, context).search();
}

double separation_distance(const std::vector<Circle>& a, const std::vector<Circle>& b, const std::vector<int>& match)
{
    require_same_count(a, b);
    std::vector<int> all = numbers_below<int>(a.size());
    if (!std::is_permutation(all.begin(), all.end(), match.begin(), match.end()))
        throw InputError("the match must name each of the " + std::to_string(a.size()) + " loops once");
    const MatrixXd of_a = conformal_separations(a), of_b = conformal_separations(b)(match, match);
    return root_mean(0.5 * (of_a - of_b).squaredNorm(), of_a.rows());
}

}  // namespace koebe
