// The motion of the plane that brings points nearest to other points.
#pragma once

#include "core/types.h"

#include <algorithm>
#include <cmath>

namespace koebe {

/// Weighted sums over pairs of places, from which the motion of the second ones onto the first ones follows (least
/// squares: Horn 1987, in the plane). Sums of a range of pairs are the difference of two.
struct RigidFit {
    double weight = 0.0, first_squares = 0.0, second_squares = 0.0;
    Complex first = 0.0, second = 0.0, product = 0.0;

    void add(Complex a, Complex b, double w = 1.0)
    {
        weight += w;
        first_squares += w * std::norm(a);
        second_squares += w * std::norm(b);
        first += w * a;
        second += w * b;
        product += w * a * std::conj(b);
    }
    RigidFit operator-(const RigidFit& other) const
    {
        return {weight - other.weight,
                first_squares - other.first_squares,
                second_squares - other.second_squares,
                first - other.first,
                second - other.second,
                product - other.product};
    }

    /// The sum of squared distances from the middle, of the first places and of the second.
    double first_spread() const { return std::max(0.0, first_squares - std::norm(first) / weight); }
    double second_spread() const { return std::max(0.0, second_squares - std::norm(second) / weight); }

    /// The turn, of length 1; 1 if no turn is better than another.
    Complex turn() const
    {
        const Complex sum = centered_product();
        return std::abs(sum) > 0.0 ? sum / std::abs(sum) : Complex(1.0);
    }
    /// Where a second place goes: about the middles, by the turn, `scale` times as large.
    Complex moved(Complex b, double scale = 1.0) const
    {
        return first / weight + scale * turn() * (b - second / weight);
    }
    /// The mean square distance of the first places from the second ones, where they are.
    double distance() const { return std::max(0.0, first_squares + second_squares - 2.0 * product.real()) / weight; }
    /// The mean square distance of the first places from the moved second ones.
    double misfit() const
    {
        return std::max(0.0, first_spread() + second_spread() - 2.0 * std::abs(centered_product())) / weight;
    }

private:
    Complex centered_product() const { return product - first * std::conj(second) / weight; }
};

}  // namespace koebe
