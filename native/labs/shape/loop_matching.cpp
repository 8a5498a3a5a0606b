#include "shape/loop_matching.h"

#include "core/errors.h"
#include "core/numbering.h"
#include "shape/assignment.h"
#include "shape/conformal_module.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace koebe {
namespace {

constexpr std::size_t exhaustive_loops = 7;  // inner loops; 7! = 5040 correspondences
constexpr std::size_t most_starts = 32;      // pairs of loops that are tried for one
constexpr int most_refinements = 8;
constexpr double no_distance = 1e-10;  // of equal shapes up to rounding: the search ends there

/// From so many loops on, only the most promising starts are followed. Each takes time with the square of their number.
constexpr std::size_t many_loops = 250;

std::size_t followed_starts(std::size_t loops)
{
    return loops < many_loops ? most_starts : std::max<std::size_t>(most_starts * many_loops / loops, 4);
}

/// One of the domains, seen from one of its loops as the outer one.
struct View {
    const std::vector<Circle>& circles;
    int outer;
    std::vector<int> inner;          ///< by separation, nearest first
    std::vector<double> separation;  ///< of every circle from the outer circle

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

/// Orders in which inner[i] of one domain corresponds to partner[i] of the other.
LoopMatch in_common_order(const View& a, const View& b, const std::vector<int>& inner, const std::vector<int>& partner)
{
    std::vector<std::size_t> rank = numbers_below<std::size_t>(inner.size());
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

/// b's loop for each of a's.
std::vector<int> loops_of_b(const LoopMatch& match)
{
    std::vector<int> result(match.order_a.size());
    for (std::size_t i = 0; i < result.size(); ++i) result[match.order_a[i]] = match.order_b[i];
    return result;
}

/// The best correspondence of those that were tried, and the distance of the next best one.
struct Best {
    LoopMatch match;
    double next = std::numeric_limits<double>::infinity();

    Best() { match.distance = next; }

    void offer(LoopMatch other)
    {
        // The same correspondence, seen from another outer loop, has another distance, but is no other one.
        if (match.order_a.size() != other.order_a.size() || loops_of_b(match) != loops_of_b(other))
            next = std::min(next, std::max(match.distance, other.distance));
        if (other.distance < match.distance) match = std::move(other);
    }

    /// Also what was second best there.
    void offer(Best other)
    {
        const double second = other.next;
        offer(std::move(other.match));
        next = std::min(next, std::max(match.distance, second));
    }

    Best swapped() &&
    {
        std::swap(match.order_a, match.order_b);
        return std::move(*this);
    }

    /// The match, with its margin. Equal shapes differ by rounding only.
    LoopMatch found()
    {
        if (next < std::numeric_limits<double>::infinity())
            match.margin = next <= no_distance ? 0.0 : 1.0 - match.distance / next;
        return std::move(match);
    }
};

void try_all(const View& a, const View& b, Best& best)
{
    std::vector<int> partner = b.inner;
    std::ranges::sort(partner);
    do best.offer(in_common_order(a, b, a.inner, partner));
    while (std::next_permutation(partner.begin(), partner.end()));
}

constexpr Eigen::Index fixed = 3;  // number of loops that fix the position

/// Squared differences of the circles that do not fix the position, a's as rows.
MatrixXd costs(const View& a, const View& b, const LoopMatch& given)
{
    const auto coordinates = [](const std::vector<Circle>& circles) {
        Eigen::Array3Xd result(3, static_cast<Eigen::Index>(circles.size()) - fixed);
        for (Eigen::Index k = 0; k < result.cols(); ++k) {
            const Circle& circle = circles[static_cast<std::size_t>(fixed + k)];
            result.col(k) << circle.center.real(), circle.center.imag(), circle.radius;
        }
        return result;
    };
    const Eigen::Array3Xd of_a = coordinates(normalized_circles(a.circles, given.order_a));
    const Eigen::Array3Xd of_b = coordinates(normalized_circles(b.circles, given.order_b));
    MatrixXd cost(of_a.cols(), of_b.cols());
    for (Eigen::Index j = 0; j < cost.cols(); ++j)
        cost.col(j) = (of_a.colwise() - of_b.col(j)).square().colwise().sum().transpose();
    return cost;
}

/// Assigns all but the first three loops again, in the position that these three fix.
LoopMatch reassigned(const View& a, const View& b, const LoopMatch& given, const ExecutionContext& context)
{
    std::vector<int> inner(given.order_a.begin() + 1, given.order_a.end());
    std::vector<int> partner(given.order_b.begin() + 1, given.order_b.begin() + fixed);
    for (const int j : least_cost_assignment(costs(a, b, given), context)) partner.push_back(given.order_b[fixed + j]);
    return in_common_order(a, b, inner, partner);
}

/// Orders that begin with the outer loops and a pair of inner ones, and a lower bound of their cost: every other loop
/// goes with its nearest.
struct Start {
    LoopMatch match;
    double least_cost = 0.0;
};

/// The promising pairs of b's loops for the first two of a's, best first.
std::vector<Start> starts(const View& a, const View& b, const ExecutionContext& context)
{
    struct Candidate {
        int first, second;
        double mismatch;
    };
    // Pairs with the most similar separations, from the outer loop and from each other.
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
    candidates.resize(std::min(candidates.size(), most_starts));

    // A lower bound of each start's cost: each loop takes its cheapest partner.
    std::vector<Start> result;
    for (const Candidate& pair : candidates) {
        context.checkpoint();
        LoopMatch match{{a.outer}, {b.outer, pair.first, pair.second}};
        match.order_a.insert(match.order_a.end(), a.inner.begin(), a.inner.end());
        for (const int k : b.inner)
            if (k != pair.first && k != pair.second) match.order_b.push_back(k);
        const MatrixXd cost = costs(a, b, match);
        const double least = std::max(cost.rowwise().minCoeff().sum(), cost.colwise().minCoeff().sum());
        result.push_back({std::move(match), least});
    }
    std::ranges::stable_sort(result, {}, &Start::least_cost);
    result.resize(std::min(result.size(), followed_starts(a.inner.size())));
    return result;
}

Best search(const View& a, const View& b, const ExecutionContext& context)
{
    Best best;
    const bool many = a.inner.size() >= many_loops;
    for (const Start& start : starts(a, b, context)) {
        if (many && std::sqrt(start.least_cost) >= best.match.distance) break;
        LoopMatch match = reassigned(a, b, start.match, context);
        for (int i = 0; i < most_refinements && match.distance > no_distance; ++i) {
            LoopMatch next = reassigned(a, b, match, context);
            if (!(next.distance < match.distance)) break;
            match = std::move(next);
        }
        match.exhaustive = false;
        best.offer(std::move(match));
        if (many && best.match.distance <= no_distance) break;
    }
    return best;
}

/// Offers the best correspondence of the views, and the next best one.
void match_views(const View& a, const View& b, const ExecutionContext& context, Best& best)
{
    context.checkpoint();
    if (a.inner.size() <= exhaustive_loops) return try_all(a, b, best);
    best.offer(search(a, b, context));
    if (best.match.distance <= no_distance) return;
    best.offer(search(b, a, context).swapped());
}

/// The loops of `circles` that may correspond to the other domain's outer loop, best first: their separations from the
/// other loops are most like that loop's.
std::vector<int> likely_outer(const View& other, const std::vector<Circle>& circles, const ExecutionContext& context)
{
    std::vector<std::pair<double, int>> likely;
    for (int k = 1; k < static_cast<int>(circles.size()); ++k) {
        context.checkpoint();
        const View view(circles, k);
        double unlike = 0.0;
        for (std::size_t i = 0; i < view.inner.size(); ++i)
            unlike += std::abs(view.separation[view.inner[i]] - other.separation[other.inner[i]]);
        likely.emplace_back(unlike, k);
    }
    std::ranges::sort(likely);
    likely.resize(std::min(likely.size(), followed_starts(circles.size())));
    std::vector<int> loops;
    for (const auto& [unlike, k] : likely) loops.push_back(k);
    return loops;
}

}  // namespace

LoopMatch match_loops(const std::vector<Circle>& a, const std::vector<Circle>& b, bool any_outer,
                      const ExecutionContext& context)
{
    require_circle_domain(a);
    require_circle_domain(b);
    if (a.size() != b.size())
        throw InputError("the surfaces have " + std::to_string(a.size()) + " and " + std::to_string(b.size()) +
                         " loops: their modules cannot be compared");
    const View first_a(a, 0), first_b(b, 0);
    Best best;
    match_views(first_a, first_b, context, best);
    if (!any_outer) return best.found();
    for (const int k : likely_outer(first_a, b, context)) match_views(first_a, View(b, k), context, best);
    for (const int k : likely_outer(first_b, a, context)) match_views(View(a, k), first_b, context, best);
    return best.found();
}

}  // namespace koebe
