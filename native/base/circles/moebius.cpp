#include "circles/moebius.h"

#include <cmath>

namespace koebe {

VectorXcd Moebius::operator()(const VectorXcd& z) const
{
    return turn * ((z.array() - a) / (1.0 - std::conj(a) * z.array()));
}

Circle Moebius::operator()(const Circle& circle) const
{
    if (a == Complex(0.0, 0.0)) return {turn * circle.center, circle.radius};
    // The point inverse to the pole with respect to the circle goes to the centre of the image.
    const Complex pole = 1.0 / std::conj(a);
    const Complex inverse_pole = circle.center + circle.radius * circle.radius / std::conj(pole - circle.center);
    const Complex center = (*this)(inverse_pole);
    return {center, std::abs((*this)(circle.center + circle.radius) - center)};
}

Moebius Moebius::operator*(const Moebius& first) const
{
    // The product sends first^-1(a) to 0; its turn follows from its image of 1.
    const Moebius product{first.inverse()(a), Complex(1.0, 0.0)};
    const Complex one(1.0, 0.0), twist = (*this)(first(one)) / product(one);
    return {product.a, twist / std::abs(twist)};
}

Moebius center_circle(const Circle& circle)
{
    // The common inverse points of the two circles lie on the line through both centres at distances t and 1 / t
    // with t + 1 / t = (1 + |c|^2 - r^2) / |c|.
    const double distance = std::abs(circle.center);
    if (distance == 0.0) return {};
    const double half_sum = 0.5 * (1.0 + distance * distance - circle.radius * circle.radius) / distance;
    const double t = 1.0 / (half_sum + std::sqrt(half_sum * half_sum - 1.0));
    return {t * circle.center / distance, Complex(1.0, 0.0)};
}

}  // namespace koebe
