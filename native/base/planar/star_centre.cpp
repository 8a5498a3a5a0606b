#include "planar/star_centre.h"

#include "planar/planar_predicates.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace koebe {
namespace {

constexpr int most_steps = 40;
constexpr double settled = 1e-6;  // Newton's decrement, over the least weight

/// Twice the least area of the faces from x to each edge.
double least_area(const std::vector<Complex>& polygon, Complex x)
{
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < polygon.size(); ++i)
        least = std::min(least, cross(polygon[i] - x, polygon[(i + 1) % polygon.size()] - x));
    return least;
}

/// The mean corner of the kernel, computed as the polygon's box cut by the line of each edge.
std::optional<Complex> kernel_point(const std::vector<Complex>& polygon)
{
    // Begin with the box.
    double left = polygon[0].real(), right = left, low = polygon[0].imag(), high = low;
    for (const Complex p : polygon) {
        left = std::min(left, p.real());
        right = std::max(right, p.real());
        low = std::min(low, p.imag());
        high = std::max(high, p.imag());
    }
    std::vector<Complex> kernel{{left, low}, {right, low}, {right, high}, {left, high}}, cut;
    // Cut it by the half plane left of each edge (Sutherland and Hodgman).
    for (std::size_t i = 0; i < polygon.size() && !kernel.empty(); ++i) {
        const Complex a = polygon[i], edge = polygon[(i + 1) % polygon.size()] - a;
        cut.clear();
        for (std::size_t k = 0; k < kernel.size(); ++k) {
            const Complex p = kernel[k], q = kernel[(k + 1) % kernel.size()];
            const double p_side = cross(edge, p - a), q_side = cross(edge, q - a);
            if (p_side >= 0.0) cut.push_back(p);
            if ((p_side > 0.0 && q_side < 0.0) || (p_side < 0.0 && q_side > 0.0))
                cut.push_back(p + p_side / (p_side - q_side) * (q - p));
        }
        kernel.swap(cut);
    }
    if (kernel.empty()) return {};
    Complex sum = 0.0;
    for (const Complex p : kernel) sum += p;
    return sum / static_cast<double>(kernel.size());
}

}  // namespace

std::optional<Complex> star_centre(const std::vector<Complex>& polygon, const std::vector<double>& weights,
                                   const std::optional<Complex>& start)
{
    std::optional<Complex> found = start;
    if (!found || !(least_area(polygon, *found) > 0.0)) found = kernel_point(polygon);
    if (!found || !(least_area(polygon, *found) > 0.0)) return {};
    Complex x = *found;
    const std::size_t n = polygon.size();
    const double lightest = *std::min_element(weights.begin(), weights.end());
    for (int step = 0; step < most_steps; ++step) {
        // Gradient (gx, gy) and Hessian (xx, xy, yy) of -sum w log area.
        double gx = 0.0, gy = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
            const Complex a = polygon[i] - x, b = polygon[(i + 1) % n] - x;
            const double area = cross(a, b);
            // The area's gradient divided by the area.
            const double sx = (a.imag() - b.imag()) / area, sy = (b.real() - a.real()) / area;
            gx -= weights[i] * sx;
            gy -= weights[i] * sy;
            xx += weights[i] * sx * sx;
            xy += weights[i] * sx * sy;
            yy += weights[i] * sy * sy;
        }
        const double determinant = xx * yy - xy * xy;
        if (!(determinant > 0.0) || !std::isfinite(determinant)) break;
        const Complex direction(-(yy * gx - xy * gy) / determinant, -(xx * gy - xy * gx) / determinant);
        const double decrement = -(gx * direction.real() + gy * direction.imag());
        if (!(decrement > settled * lightest)) break;
        double most = 1.0;  // largest step that leaves every face a tenth of its area
        for (std::size_t i = 0; i < n; ++i) {
            const Complex a = polygon[i] - x, b = polygon[(i + 1) % n] - x;
            const double change = cross(direction, b - a) / -cross(a, b);
            if (-change * most > 0.9) most = -0.9 / change;
        }
        const auto rise = [&](double share) {
            double sum = 0.0;
            for (std::size_t i = 0; i < n; ++i) {
                const Complex a = polygon[i] - x, b = polygon[(i + 1) % n] - x;
                sum += weights[i] * std::log1p(share * cross(direction, b - a) / -cross(a, b));
            }
            return sum;
        };
        double share = most;
        while (share > 1e-6 * most && !(rise(share) > 0.1 * share * decrement)) share *= 0.5;
        const Complex trial = x + share * direction;
        if (trial == x || !(least_area(polygon, trial) > 0.0)) break;
        x = trial;
    }
    return x;
}

}  // namespace koebe
