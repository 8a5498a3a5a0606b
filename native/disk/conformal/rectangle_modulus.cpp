#include "conformal/rectangle_modulus.h"

#include <cmath>

namespace koebe {
namespace {

double arithmetic_geometric_mean(double a, double b)
{
    constexpr double rounding = 1e-15;
    constexpr int most_rounds = 60;
    for (int i = 0; i < most_rounds && std::abs(a - b) > rounding * a; ++i) {
        const double mean = 0.5 * (a + b);
        b = std::sqrt(a * b);
        a = mean;
    }
    return a;
}

}  // namespace

double rectangle_modulus(const std::array<Complex, 4>& corners)
{
    const auto chord = [&](int i, int j) { return std::abs(corners[i] - corners[j]); };
    const double whole = chord(0, 2) * chord(1, 3);  // by Ptolemy's theorem
    return arithmetic_geometric_mean(1.0, std::sqrt(chord(0, 1) / whole * chord(2, 3))) /
           arithmetic_geometric_mean(1.0, std::sqrt(chord(1, 2) / whole * chord(3, 0)));
}

}  // namespace koebe
