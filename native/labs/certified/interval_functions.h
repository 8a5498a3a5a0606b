// Elementary functions of intervals, from their series: nothing of the C library is trusted.
#pragma once

#include "certified/interval.h"

#include <cstddef>

namespace koebe {

inline const Interval enclosed_two_pi{0x1.921fb54442d18p2, 0x1.921fb54442d19p2};

/// A point of the plane, its coordinates doubles or intervals.
template <class Real>
struct Plane {
    Real re{}, im{};
};

template <class Real>
Plane<Real> operator+(const Plane<Real>& a, const Plane<Real>& b)
{
    return {a.re + b.re, a.im + b.im};
}

template <class Real>
Plane<Real> operator-(const Plane<Real>& a, const Plane<Real>& b)
{
    return {a.re - b.re, a.im - b.im};
}

template <class Real>
Plane<Real> operator*(const Plane<Real>& a, const Plane<Real>& b)
{
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}

template <class Real>
Plane<Real> operator*(const Plane<Real>& a, const Real& b)
{
    return {a.re * b, a.im * b};
}

template <class Real>
Plane<Real> conjugate(const Plane<Real>& a)
{
    return {a.re, Real(0.0) - a.im};
}

inline double squared(double x) { return x * x; }
inline double logarithm(double x) { return std::log(x); }

/// @param x above 0 @return everything if it is not
Interval logarithm(const Interval& x);
Interval exponential_between(const Interval& x);

template <class Real>
Real squared_length(const Plane<Real>& a)
{
    return squared(a.re) + squared(a.im);
}

inline double inverse_of(double x) { return 1.0 / x; }

/// @param x above 0 @return everything if it is not
inline Interval inverse_of(const Interval& x)
{
    constexpr double infinite = std::numeric_limits<double>::infinity();
    return x.lower > 0.0 ? Interval(1.0) / x : Interval(-infinite, infinite);
}

template <class Real>
Plane<Real> inverse_of(const Plane<Real>& a)
{
    return conjugate(a) * inverse_of(squared_length(a));
}

/// exp(2 pi i part / whole). @param part from 0 to whole
Plane<Interval> unit_root(std::ptrdiff_t part, std::ptrdiff_t whole);

}  // namespace koebe
