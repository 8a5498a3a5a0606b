#include "certified/interval_functions.h"

#include <utility>

namespace koebe {
namespace {

const Interval log_two{0x1.62e42fefa39efp-1, 0x1.62e42fefa39f0p-1};
constexpr double root_half = 0x1.6a09e667f3bcdp-1;
constexpr int logarithm_terms = 12;  // of (m - 1) / (m + 1), at most 0.172: the rest is below 1e-19
constexpr int series_terms = 21;     // of exp, up to 0.35, and of cos and sin, up to pi / 4: below 1e-21

Interval plus_minus(double size) { return {-size, size}; }

/// x = m 2^e, log m = 2 artanh((m - 1) / (m + 1)).
Interval logarithm_of(double x)
{
    int e = 0;
    double m = std::frexp(x, &e);
    if (m < root_half) {
        m *= 2.0;
        --e;
    }
    const Interval s = (Interval(m) - Interval(1.0)) / (Interval(m) + Interval(1.0));
    const Interval step = squared(s);
    Interval sum, power = s;
    for (int k = 0; k < logarithm_terms; ++k, power = power * step) sum = sum + power / Interval(2.0 * k + 1.0);
    return Interval(2.0) * (sum + plus_minus(power.magnitude())) + Interval(e) * log_two;
}

Interval exponential_of(double x)
{
    const double halvings = std::nearbyint(x / log_two.lower);
    const Interval rest = Interval(x) - Interval(halvings) * log_two;
    Interval sum(1.0), term(1.0);
    for (int k = 1; k <= series_terms; ++k) sum = sum + (term = term * rest / Interval(k));
    sum = sum + plus_minus(term.magnitude());
    const int exponent = static_cast<int>(std::clamp(halvings, -1e5, 1e5));
    return {std::max(below(std::ldexp(sum.lower, exponent)), 0.0), above(std::ldexp(sum.upper, exponent))};
}

}  // namespace

Interval logarithm(const Interval& x)
{
    constexpr double infinite = std::numeric_limits<double>::infinity();
    if (!(x.lower > 0.0 && x.upper < infinite)) return {-infinite, infinite};
    return {logarithm_of(x.lower).lower, logarithm_of(x.upper).upper};
}

Interval exponential_between(const Interval& x)
{
    return {exponential_of(x.lower).lower, exponential_of(x.upper).upper};
}

Plane<Interval> unit_root(std::ptrdiff_t part, std::ptrdiff_t whole)
{
    // The angle is a number of quarters, plus or minus up to an eighth of a turn.
    const std::ptrdiff_t eighths = 8 * part / whole, rest = 8 * part % whole;
    const bool back = eighths % 2 == 1;
    const Interval angle = enclosed_two_pi * Interval(static_cast<double>(back ? whole - rest : rest)) /
                           Interval(8.0 * static_cast<double>(whole));
    Interval sums[2]{Interval(1.0), Interval()}, term(1.0);  // of even and odd powers
    for (int k = 1; k <= series_terms; ++k) {
        term = term * angle / Interval(k);
        sums[k % 2] = k % 4 < 2 ? sums[k % 2] + term : sums[k % 2] - term;
    }
    Plane<Interval> root{sums[0] + plus_minus(term.magnitude()), sums[1] + plus_minus(term.magnitude())};
    if (back) root = conjugate(root);
    for (std::ptrdiff_t quarter = 0; quarter < (eighths + 1) / 2; ++quarter) root = {-root.im, root.re};
    return root;
}

}  // namespace koebe
