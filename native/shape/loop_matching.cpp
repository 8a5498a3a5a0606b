#include "shape/loop_matching.h"

#include "core/errors.h"
#include "shape/assignment.h"
#include "shape/conformal_module.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace koebe {
namespace {

constexpr std::size_t exhaustive_loops = 7;  // inner loops; 7! = 5040 correspondences
constexpr std::size_t most_candidates = 32;  // pairs of loops that are tried for one
constexpr int most_refinements = 8;

/// One of the domains, seen from one of its loops as the outer one.
struct View {
    const std::vector<Circle>& circles;
    int outer;
    std::vector<int> inner;          ///< by separation, nearest first
    std::vector<double> separation;  ///< of every circle from the outer one

    View(const std::vector<Circle>& all, int chosen) : circles(all), outer(chosen)
    {
        for (std::size_t k = 0; k < all.size(); ++k) {
            const bool self = static_cast<int>(k) == chosen;
            separation.push_back(self ? 0.0 : conformal_separation(all[chosen], all[k]));
            if (!self) inner.push_back(static_cast<int>(k));
        }
        std::ranges::stable_sort(inner, {}, [this](int k) { return separation[k]; });
    }
};

/// Corresponding loops are inner[i] of one and partner[i] of the other.
LoopMatch in_common_order(const View& a, const View& b, const std::vector<int>& inner, const std::vector<int>& partner)
{
    std::vector<std::size_t> rank(inner.size());
    std::iota(rank.begin(), rank.end(), std::size_t{0});
    std::ranges::stable_sort(rank, {},
                             [&](std::size_t i) { return a.separation[inner[i]] + b.separation[partner[i]]; });
    LoopMatch match{{a.outer}, {b.outer}};
    for (const std::size_t i : rank) {
        match.order_a.push_back(inner[i]);
        match.order_b.push_back(partner[i]);
    }
    const auto of_a = normalized_circles(a.circles, match.order_a), of_b = normalized_circles(b.circles, match.order_b);
    double sum = 0.0;
    for (std::size_t k = 1; k < of_a.size(); ++k)
        sum += std::norm(of_a[k].center - of_b[k].center) + std::pow(of_a[k].radius - of_b[k].radius, 2);
    match.distance = std::sqrt(sum);
    return match;
}

LoopMatch try_all(const View& a, const View& b)
{
    std::vector<int> partner = b.inner;
    std::ranges::sort(partner);
    LoopMatch best = in_common_order(a, b, a.inner, partner);
    while (std::next_permutation(partner.begin(), partner.end())) {
        LoopMatch next = in_common_order(a, b, a.inner, partner);
        if (next.distance < best.distance) best = std::move(next);
    }
    return best;
}

/// The orders with all but the first three loops assigned anew, in the position that these three fix.
LoopMatch reassigned(const View& a, const View& b, const LoopMatch& given)
{
    constexpr Eigen::Index fixed = 3;
    const auto of_a = normalized_circles(a.circles, given.order_a), of_b = normalized_circles(b.circles, given.order_b);
    const Eigen::Index n = static_cast<Eigen::Index>(of_a.size()) - fixed;
    MatrixXd cost(n, n);
    for (Eigen::Index i = 0; i < n; ++i)
        for (Eigen::Index j = 0; j < n; ++j)
            cost(i, j) = std::norm(of_a[fixed + i].center - of_b[fixed + j].center) +
                         std::pow(of_a[fixed + i].radius - of_b[fixed + j].radius, 2);
    std::vector<int> inner(given.order_a.begin() + 1, given.order_a.end());
    std::vector<int> partner(given.order_b.begin() + 1, given.order_b.begin() + fixed);
    for (const int j : least_cost_assignment(cost)) partner.push_back(given.order_b[fixed + j]);
    return in_common_order(a, b, inner, partner);
}

/// Starts with each of the promising pairs of b's loops for the first two of a's.
LoopMatch search(const View& a, const View& b)
{
    struct Candidate {
        int first, second;
        double mismatch;
    };
    const int one = a.inner[0], two = a.inner[1];
    const double between = conformal_separation(a.circles[one], a.circles[two]);
    std::vector<Candidate> candidates;
    for (const int k : b.inner)
        for (const int l : b.inner)
            if (k != l)
                candidates.push_back({k, l,
                                      std::abs(a.separation[one] - b.separation[k]) +
                                          std::abs(a.separation[two] - b.separation[l]) +
                                          std::abs(between - conformal_separation(b.circles[k], b.circles[l]))});
    std::ranges::stable_sort(candidates, {}, &Candidate::mismatch);
    candidates.resize(std::min(candidates.size(), most_candidates));

    LoopMatch best;
    best.distance = std::numeric_limits<double>::infinity();
    for (const Candidate& pair : candidates) {
        LoopMatch start{{a.outer}, {b.outer, pair.first, pair.second}};
        start.order_a.insert(start.order_a.end(), a.inner.begin(), a.inner.end());
        for (const int k : b.inner)
            if (k != pair.first && k != pair.second) start.order_b.push_back(k);
        LoopMatch match = reassigned(a, b, start);
        for (int i = 0; i < most_refinements; ++i) {
            LoopMatch next = reassigned(a, b, match);
            if (!(next.distance < match.distance)) break;
            match = std::move(next);
        }
        if (match.distance < best.distance) best = std::move(match);
    }
    best.exhaustive = false;
    return best;
}

LoopMatch match_views(const View& a, const View& b)
{
    if (a.inner.size() <= exhaustive_loops) return try_all(a, b);
    LoopMatch match = search(a, b), other = search(b, a);
    if (other.distance < match.distance) {
        std::swap(other.order_a, other.order_b);
        return other;
    }
    return match;
}

}  // namespace

LoopMatch match_loops(const std::vector<Circle>& a, const std::vector<Circle>& b, bool any_outer)
{
    require_circle_domain(a);
    require_circle_domain(b);
    if (a.size() != b.size())
        throw InputError("the surfaces have " + std::to_string(a.size()) + " and " + std::to_string(b.size()) +
                         " loops: their modules cannot be compared");
    LoopMatch best = match_views(View(a, 0), View(b, 0));
    for (int k = 1; any_outer && k < static_cast<int>(a.size()); ++k)
        for (LoopMatch& next : std::vector{match_views(View(a, 0), View(b, k)), match_views(View(a, k), View(b, 0))})
            if (next.distance < best.distance) best = std::move(next);
    return best;
}

}  // namespace koebe
