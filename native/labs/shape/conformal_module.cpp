#include "shape/conformal_module.h"

#include "circles/circle_fit.h"
#include "core/errors.h"
#include "core/numbering.h"

#include <algorithm>
#include <cmath>

namespace koebe {
namespace {

constexpr double alike = 1e-2;              // separations nearer than this count as equal, dimensionless
constexpr std::size_t most_orders = 5040;   // 7!
constexpr double least_radius = 1e-100;     // unit disk: smaller radii have squares that vanish in rounding
constexpr double unit_circle_error = 1e-6;  // of the outer circle's centre and radius, a length in the unit disk

std::vector<int> checked_order(std::size_t count, const std::vector<int>& order)
{
    std::vector<int> natural = numbers_below<int>(count);
    if (order.empty()) return natural;
    if (!std::is_permutation(natural.begin(), natural.end(), order.begin(), order.end()))
        throw InputError("the order must name each of the " + std::to_string(count) + " loops once");
    return order;
}

/// The image under w = R / (z - C) of a circle that does not pass through C.
Circle inverted(const Circle& circle, const Circle& pole)
{
    const Complex arm = circle.center - pole.center;
    const double power = std::norm(arm) - circle.radius * circle.radius;
    return {pole.radius * std::conj(arm) / power, pole.radius * circle.radius / std::abs(power)};
}

/// The circles in this order, with the first one inverted onto the unit circle.
std::vector<Circle> with_outer(const std::vector<Circle>& circles, const std::vector<int>& order)
{
    std::vector<Circle> placed{Circle{}};
    for (std::size_t k = 1; k < order.size(); ++k) {
        const Circle& circle = circles[order[k]];
        placed.push_back(order[0] == 0 ? circle : inverted(circle, circles[order[0]]));
    }
    return placed;
}

VectorXd module_of(const std::vector<Circle>& normalized)
{
    std::vector<double> numbers;
    for (std::size_t k = 1; k < normalized.size(); ++k) {
        if (k > 2) numbers.push_back(normalized[k].center.real());
        if (k > 1) numbers.push_back(normalized[k].center.imag());
        numbers.push_back(normalized[k].radius);
    }
    return Eigen::Map<const VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

/// First places of the runs of equal numbers in an ascending list, and its length.
std::vector<std::size_t> runs_of_alike(const std::vector<double>& ascending)
{
    std::vector<std::size_t> begin{0};
    for (std::size_t i = 1; i < ascending.size(); ++i)
        if (ascending[i] - ascending[i - 1] > alike) begin.push_back(i);
    begin.push_back(ascending.size());
    return begin;
}

/// The next of the orders that permute within runs; false after the last.
bool next_within(std::vector<int>& order, const std::vector<std::size_t>& runs)
{
    for (std::size_t r = 0; r + 1 < runs.size(); ++r)
        if (std::next_permutation(order.begin() + 1 + static_cast<std::ptrdiff_t>(runs[r]),
                                  order.begin() + 1 + static_cast<std::ptrdiff_t>(runs[r + 1])))
            return true;
    return false;
}

double score(const VectorXd& module)
{
    double sum = 0.0;
    for (Eigen::Index i = 0; i < module.size(); ++i) sum += module[i] / static_cast<double>(i + 1);
    return sum;
}

/// The best order with this outer loop, and its score.
std::pair<double, std::vector<int>> best_order(const std::vector<Circle>& circles, int outer)
{
    // By separation from the outer loop, which no Moebius map changes.
    std::vector<int> order;
    for (std::size_t k = 0; k < circles.size(); ++k)
        if (static_cast<int>(k) != outer) order.push_back(static_cast<int>(k));
    const auto separation = [&](int k) { return conformal_separation(circles[outer], circles[k]); };
    std::ranges::stable_sort(order, {}, separation);
    std::vector<double> keys;
    for (const int k : order) keys.push_back(separation(k));
    const std::vector<std::size_t> runs = runs_of_alike(keys);
    order.insert(order.begin(), outer);

    // Among loops that are alike, try all orders, if there are not too many.
    double orders = 1.0;
    for (std::size_t r = 0; r + 1 < runs.size(); ++r) {
        std::sort(order.begin() + 1 + static_cast<std::ptrdiff_t>(runs[r]),
                  order.begin() + 1 + static_cast<std::ptrdiff_t>(runs[r + 1]));
        orders *= std::tgamma(static_cast<double>(runs[r + 1] - runs[r]) + 1.0);
    }
    std::pair<double, std::vector<int>> best{score(module_of(normalized_circles(circles, order))), order};
    if (orders > static_cast<double>(most_orders)) {
        std::stable_sort(order.begin() + 1, order.end(), [&](int a, int b) { return separation(a) < separation(b); });
        return {score(module_of(normalized_circles(circles, order))), order};
    }
    while (next_within(order, runs)) {
        const double value = score(module_of(normalized_circles(circles, order)));
        if (value > best.first) best = {value, order};
    }
    return best;
}

}  // namespace

double conformal_separation(const Circle& a, const Circle& b) { return std::acosh(inversive_distance(a, b)); }

void require_circle_domain(const std::vector<Circle>& circles)
{
    if (circles.empty()) throw InputError("a circle domain has one circle at least");
    if (std::abs(circles[0].center) > unit_circle_error || std::abs(circles[0].radius - 1.0) > unit_circle_error)
        throw InputError("the first circle must be the unit circle", ElementKind::loops, {0});
    for (std::size_t i = 1; i < circles.size(); ++i) {
        const bool inside = circles[i].radius >= least_radius && std::abs(circles[i].center) + circles[i].radius < 1.0;
        if (!inside)
            throw InputError("a circle does not lie in the unit disk, or its radius is below 1e-100 (number listed)",
                             ElementKind::loops, {static_cast<Index>(i)});
        for (std::size_t j = 1; j < i; ++j)
            if (!(std::abs(circles[i].center - circles[j].center) > circles[i].radius + circles[j].radius))
                throw InputError("the circles of two loops meet: the mesh is too coarse there (their numbers listed)",
                                 ElementKind::loops, {static_cast<Index>(j), static_cast<Index>(i)});
    }
}

Moebius normalizing_map(const std::vector<Circle>& circles)
{
    if (circles.size() < 2) return {};
    Moebius map = center_circle(circles[1]);
    if (circles.size() > 2) {
        const Complex second = map(circles[2]).center;
        map.turn *= Complex(0.0, 1.0) * std::abs(second) / second;
    }
    return map;
}

std::vector<Circle> normalized_circles(const std::vector<Circle>& circles, const std::vector<int>& order)
{
    std::vector<Circle> placed = with_outer(circles, checked_order(circles.size(), order));
    const Moebius map = normalizing_map(placed);
    for (std::size_t k = 1; k < placed.size(); ++k) placed[k] = map(placed[k]);
    return placed;
}

VectorXd conformal_module(const std::vector<Circle>& circles, const std::vector<int>& order)
{
    require_circle_domain(circles);
    return module_of(normalized_circles(circles, order));
}

std::vector<std::string> module_names(std::size_t loop_count)
{
    std::vector<std::string> names;
    for (std::size_t k = 1; k < loop_count; ++k)
        for (const char* letter : {"x_", "y_", "r_"})
            if (*letter == 'r' || k > 2 || (k == 2 && *letter == 'y')) names.push_back(letter + std::to_string(k));
    return names;
}

std::vector<int> canonical_order(const std::vector<Circle>& circles, bool any_outer)
{
    require_circle_domain(circles);
    if (!any_outer) return best_order(circles, 0).second;
    std::vector<double> sums(circles.size(), 0.0);
    for (std::size_t i = 0; i < circles.size(); ++i)
        for (std::size_t j = 0; j < circles.size(); ++j)
            if (i != j) sums[i] += conformal_separation(circles[i], circles[j]);
    const double least = *std::ranges::min_element(sums);
    std::pair<double, std::vector<int>> best;
    for (std::size_t k = 0; k < circles.size(); ++k) {
        if (sums[k] > least + alike) continue;
        auto candidate = best_order(circles, static_cast<int>(k));
        if (best.second.empty() || candidate.first > best.first) best = std::move(candidate);
    }
    return best.second;
}

void require_own_circles(const std::vector<LoopReport>& loops)
{
    std::vector<Index> shrunk;
    for (std::size_t k = 0; k < loops.size(); ++k)
        if (loops[k].shrunk) shrunk.push_back(static_cast<Index>(k));
    if (!shrunk.empty())
        throw InputError(
            "the circles of " + std::to_string(shrunk.size()) +
                " loops say nothing about the surface, because the mesh is too coarse or rounding loses them: "
                "there is no conformal module (loops listed, 0 is the outer loop)",
            ElementKind::loops, shrunk);
}

}  // namespace koebe
