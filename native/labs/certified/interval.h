// Intervals that hold every result of real arithmetic on the numbers in them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace koebe {

/// A real number between two doubles. Each operation rounds to nearest, as IEEE 754 has it, and then moves both ends by
/// at least a unit in the last place outwards. So no rounding mode is changed. An end that overflows becomes infinite
/// or NaN, never a wrong finite bound.
struct Interval {
    double lower = 0.0, upper = 0.0;

    Interval() = default;
    Interval(double exact) : lower(exact), upper(exact) {}
    Interval(double from, double to) : lower(from), upper(to) {}

    double width() const { return upper - lower; }
    /// The largest absolute value.
    double magnitude() const { return std::max(std::abs(lower), std::abs(upper)); }
};

/// A number below the real number that was rounded to x.
inline double below(double x) { return x - (std::abs(x) * 0x1p-52 + std::numeric_limits<double>::denorm_min()); }
inline double above(double x) { return x + (std::abs(x) * 0x1p-52 + std::numeric_limits<double>::denorm_min()); }

inline Interval operator-(const Interval& a) { return {-a.upper, -a.lower}; }
inline Interval operator+(const Interval& a, const Interval& b)
{
    return {below(a.lower + b.lower), above(a.upper + b.upper)};
}
inline Interval operator-(const Interval& a, const Interval& b) { return a + -b; }
inline Interval operator*(const Interval& a, const Interval& b)
{
    const double p = a.lower * b.lower, q = a.lower * b.upper, r = a.upper * b.lower, s = a.upper * b.upper;
    return {below(std::min({p, q, r, s})), above(std::max({p, q, r, s}))};
}
/// @param b above 0
inline Interval operator/(const Interval& a, const Interval& b)
{
    const double p = a.lower / b.lower, q = a.lower / b.upper, r = a.upper / b.lower, s = a.upper / b.upper;
    return {below(std::min({p, q, r, s})), above(std::max({p, q, r, s}))};
}
inline Interval squared(const Interval& a)
{
    const double p = a.lower * a.lower, q = a.upper * a.upper;
    const bool has_zero = a.lower <= 0.0 && a.upper >= 0.0;
    return {has_zero ? 0.0 : std::max(below(std::min(p, q)), 0.0), above(std::max(p, q))};
}
/// @param a not below 0
inline Interval square_root(const Interval& a)
{
    return {std::max(below(std::sqrt(std::max(a.lower, 0.0))), 0.0), above(std::sqrt(a.upper))};
}

}  // namespace koebe
