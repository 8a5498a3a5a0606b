#include "iteration/disk_dirichlet_to_neumann.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace koebe {
namespace {

using std::numbers::pi;

constexpr double zeta_3 = 1.2020569031595942854;  // Apery's constant
constexpr int series_length = 26;                 // (1/2)^(2 j) falls below 2^-52 at |t| = pi

/// |B_2j| / (2j (2j+2)!) = 2 zeta(2j) / ((2 pi)^(2j) 2j (2j+1) (2j+2)).
std::array<double, series_length> series_coefficients()
{
    std::array<double, series_length> c{};
    for (int j = 1; j <= series_length; ++j) {
        double zeta = 0.0;
        for (int n = 40; n >= 1; --n) zeta += std::pow(n, -2.0 * j);
        if (j == 1) zeta = pi * pi / 6.0;
        if (j == 2) zeta = std::pow(pi, 4) / 90.0;
        if (j == 3) zeta = std::pow(pi, 6) / 945.0;
        if (j == 4) zeta = std::pow(pi, 8) / 9450.0;
        c[j - 1] = 2.0 * zeta / (std::pow(2.0 * pi, 2 * j) * (2.0 * j) * (2.0 * j + 1.0) * (2.0 * j + 2.0));
    }
    return c;
}

/// x^2/2 ln|x| - 3/4 x^2, whose second derivative is ln|x|.
double second_antiderivative_of_log(double x) { return x == 0.0 ? 0.0 : x * x * (0.5 * std::log(std::abs(x)) - 0.75); }

struct Arc {
    double middle, width;
};

/// The mean of kernel(s - t) over two arcs, from its second antiderivative.
template <class Antiderivative>
double mean_by_antiderivative(const Antiderivative& p, double t, double e, double f)
{
    const double sum = 0.5 * (e + f), difference = 0.5 * (e - f);
    return (p(t + sum) - p(t - difference) - p(t + difference) + p(t - sum)) / (e * f);
}

/// Mean of ln |2 sin((s - t) / 2)| over arcs whose middles are t apart, near or overlapping.
double near_mean(double t, double e, double f)
{
    const double widest = std::max(e, f);
    if (std::abs(t) + widest > 0.5) return mean_by_antiderivative(clausen_cosine_3, t, e, f);
    // ln|2 sin(x/2)| = ln|x| - x^2/24 - x^4/2880 - x^6/181440 - ..., the logarithm in units of the wider arc.
    const double log_mean =
        std::log(widest) + mean_by_antiderivative(second_antiderivative_of_log, t / widest, e / widest, f / widest);
    const double variance = (e * e + f * f) / 12.0;
    const double fourth = (e * e * e * e + f * f * f * f) / 80.0 + e * e * f * f / 24.0;
    const double t2 = t * t;
    return log_mean - (t2 + variance) / 24.0 - (t2 * t2 + 6.0 * t2 * variance + fourth) / 2880.0 -
           t2 * t2 * t2 / 181440.0;
}

/// The same for arcs at least `far` widths apart: Taylor's series of the kernel in the widths, from the chord.
double far_mean(double chord_squared, double e, double f)
{
    const double variance = (e * e + f * f) / 12.0;
    const double fourth = (e * e * e * e + f * f * f * f) / 80.0 + e * e * f * f / 24.0;
    const double inverse = 1.0 / chord_squared;
    return 0.5 * std::log(chord_squared) - 0.5 * variance * inverse +
           fourth / 24.0 * (inverse - 6.0 * inverse * inverse);
}
constexpr double far = 10.0;  // dimensionless; leaves a relative error near 1e-8

}  // namespace

double clausen_cosine_3(double t)
{
    static const std::array<double, series_length> coefficient = series_coefficients();
    t = std::remainder(t, 2.0 * pi);
    const double t2 = t * t;
    double tail = 0.0;
    for (int j = series_length - 1; j >= 0; --j) tail = (tail + coefficient[j]) * t2;
    return zeta_3 + second_antiderivative_of_log(t) - tail * t2;
}

MatrixXd disk_dirichlet_to_neumann(const VectorXd& angles)
{
    const Eigen::Index m = angles.size();
    std::vector<Arc> arcs(m);
    Eigen::ArrayXd x(m), y(m);
    for (Eigen::Index e = 0; e < m; ++e) {
        const double end = e + 1 < m ? angles[e + 1] : angles[0] + 2.0 * pi;
        arcs[e] = {0.5 * (angles[e] + end), end - angles[e]};
        x[e] = std::cos(arcs[e].middle);
        y[e] = std::sin(arcs[e].middle);
    }

    MatrixXd w(m, m);
    for (Eigen::Index f = 0; f < m; ++f)
        for (Eigen::Index e = f; e < m; ++e) {
            const double dx = x[e] - x[f], dy = y[e] - y[f];
            const double chord_squared = dx * dx + dy * dy;
            const double reach = far * std::max(arcs[e].width, arcs[f].width);
            const double mean = chord_squared > reach * reach
                                    ? far_mean(chord_squared, arcs[e].width, arcs[f].width)
                                    : near_mean(std::remainder(arcs[e].middle - arcs[f].middle, 2.0 * pi),
                                                arcs[e].width, arcs[f].width);
            w(e, f) = w(f, e) = -mean / pi;
        }

    // Second difference D W D', the hat at node a rising on arc a - 1 and falling on arc a.
    MatrixXd t(m, m);
    for (Eigen::Index b = 0; b < m; ++b) {
        const Eigen::Index b1 = b == 0 ? m - 1 : b - 1;
        for (Eigen::Index a = b; a < m; ++a) {
            const Eigen::Index a1 = a == 0 ? m - 1 : a - 1;
            t(a, b) = t(b, a) = w(a1, b1) - w(a1, b) - w(a, b1) + w(a, b);
        }
    }
    return t;
}

}  // namespace koebe
