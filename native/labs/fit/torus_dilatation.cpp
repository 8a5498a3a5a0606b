#include "fit/torus_dilatation.h"

#include "core/errors.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace koebe {
namespace {

/// cosh of the hyperbolic distance, minus 1.
double half_plane_gap(Complex a, Complex b) { return std::norm(a - b) / (2.0 * a.imag() * b.imag()); }

/// In the fundamental domain of the modular group.
Complex reduced_modulus(Complex tau)
{
    for (int i = 0; i < 10000; ++i) {
        tau -= std::round(tau.real());
        if (std::norm(tau) >= 1.0) return tau;
        tau = -1.0 / tau;
    }
    throw InputError("the modulus of the torus is too near the real axis");
}

}  // namespace

double torus_dilatation(Complex a, Complex b)
{
    for (const Complex tau : {a, b})
        if (!std::isfinite(tau.real()) || !std::isfinite(tau.imag()) || !(tau.imag() > 0.0))
            throw InputError("the modulus of a torus is a number above the real axis");
    Complex z = reduced_modulus(a), w = reduced_modulus(b);
    if (z.imag() < w.imag()) std::swap(z, w);
    double least = half_plane_gap(z, w);
    if (!(least < 1e100)) throw InputError("the moduli of the tori are too far apart");
    // An image of w at a distance d has at least the height of z over exp(d): finitely many (c, d).
    const double reach = w.imag() / z.imag() * (1.0 + least + std::sqrt(least * (least + 2.0)));
    const auto most_c = static_cast<long>(std::sqrt(reach) / w.imag());
    for (long c = 0; c <= most_c; ++c) {
        const double wide = std::sqrt(std::max(reach - std::pow(static_cast<double>(c) * w.imag(), 2), 0.0));
        const double middle = -static_cast<double>(c) * w.real();
        for (auto d = static_cast<long>(std::floor(middle - wide)); d <= static_cast<long>(std::ceil(middle + wide));
             ++d) {
            if (std::gcd(c, d) != 1) continue;
            // The first row (p, q) with p d - q c = 1, up to a shift.
            long p = d, q = 0;
            if (c != 0) {
                const long size = c;
                for (p = 0; p < size && ((p * d - 1) % size + size) % size != 0;) ++p;
                q = (p * d - 1) / c;
            }
            const Complex image = (static_cast<double>(p) * w + static_cast<double>(q)) /
                                  (static_cast<double>(c) * w + static_cast<double>(d));
            least = std::min(least, half_plane_gap(z, image + std::round((z - image).real())));
        }
    }
    return 1.0 + least + std::sqrt(least * (least + 2.0));
}

}  // namespace koebe
