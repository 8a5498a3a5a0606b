#include "iteration/disk_dirichlet_to_neumann.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

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

/// Values of clausen_cosine_3 at the differences of the arcs' ends, computed when first asked for. Each value is used
/// in four means.
class EndDifferences {
public:
    explicit EndDifferences(const VectorXd& angles) : angles_(angles), kept_(angles.size() <= most_kept)
    {
        if (kept_) value_ = MatrixXd::Constant(angles.size(), angles.size(), std::numeric_limits<double>::quiet_NaN());
    }
    double operator()(Eigen::Index i, Eigen::Index j)
    {
        if (i < j) std::swap(i, j);
        if (!kept_) return clausen_cosine_3(angles_[i] - angles_[j]);
        double& value = value_(i, j);
        if (std::isnan(value)) value = clausen_cosine_3(angles_[i] - angles_[j]);
        return value;
    }

private:
    static constexpr Eigen::Index most_kept = 512;  // with more arcs, hardly any are near and of unequal width
    const VectorXd& angles_;
    bool kept_;
    MatrixXd value_;
};

/// The mean of a kernel over two arcs of widths e and f, from its second antiderivative at the distances of their ends.
double mean_of_second_differences(double ends_crossed, double starts, double ends, double crossed_starts, double e,
                                  double f)
{
    return (ends_crossed - starts - ends + crossed_starts) / (e * f);
}

/// Mean of ln |2 sin((s - t) / 2)| over arcs whose middles are t apart, near or overlapping.
double near_mean(double t, double e, double f)
{
    const double widest = std::max(e, f);
    // ln|2 sin(x/2)| = ln|x| - x^2/24 - x^4/2880 - x^6/181440 - ..., the logarithm in units of the wider arc.
    const double sum = 0.5 * (e + f) / widest, difference = 0.5 * (e - f) / widest;
    const auto p = [&](double x) { return second_antiderivative_of_log(t / widest + x); };
    const double log_mean = std::log(widest) + mean_of_second_differences(p(sum), p(-difference), p(difference),
                                                                          p(-sum), e / widest, f / widest);
    const double variance = (e * e + f * f) / 12.0;
    const double fourth = (e * e * e * e + f * f * f * f) / 80.0 + e * e * f * f / 24.0;
    const double t2 = t * t;
    return log_mean - (t2 + variance) / 24.0 - (t2 * t2 + 6.0 * t2 * variance + fourth) / 2880.0 -
           t2 * t2 * t2 / 181440.0;
}

/// The same mean for arcs at least `far` widths apart: Taylor's series of the kernel in the widths, from the chord.
double far_mean(double chord_squared, double e, double f)
{
    const double variance = (e * e + f * f) / 12.0;
    const double fourth = (e * e * e * e + f * f * f * f) / 80.0 + e * e * f * f / 24.0;
    const double inverse = 1.0 / chord_squared;
    return 0.5 * std::log(chord_squared) - 0.5 * variance * inverse +
           fourth / 24.0 * (inverse - 6.0 * inverse * inverse);
}
constexpr double far = 10.0;     // dimensionless; leaves a relative error near 1e-8
constexpr double nearest = 0.5;  // rad, from middle to farther end: below, the logarithm is taken out of the kernel

/// The arcs of a loop, from each node to the next.
class Arcs {
public:
    explicit Arcs(const VectorXd& angles)
        : count_(angles.size()), arcs_(angles.size()), x_(angles.size()), y_(angles.size()), at_ends_(angles)
    {
        for (Eigen::Index e = 0; e < count_; ++e) {
            const double end = e + 1 < count_ ? angles[e + 1] : angles[0] + 2.0 * pi;
            arcs_[e] = {0.5 * (angles[e] + end), end - angles[e]};
            x_[e] = std::cos(arcs_[e].middle);
            y_[e] = std::sin(arcs_[e].middle);
        }
    }

    /// The mean of ln |2 sin((s - t) / 2)| over two arcs.
    double mean_log(Eigen::Index e, Eigen::Index f)
    {
        const double dx = x_[e] - x_[f], dy = y_[e] - y_[f];
        const double chord_squared = dx * dx + dy * dy;
        const double first = arcs_[e].width, second = arcs_[f].width, widest = std::max(first, second);
        if (chord_squared > far * widest * far * widest) return far_mean(chord_squared, first, second);
        const double t = std::remainder(arcs_[e].middle - arcs_[f].middle, 2.0 * pi);
        if (std::abs(t) + widest <= nearest) return near_mean(t, first, second);
        const Eigen::Index e1 = e + 1 < count_ ? e + 1 : 0, f1 = f + 1 < count_ ? f + 1 : 0;
        return mean_of_second_differences(at_ends_(e1, f), at_ends_(e, f), at_ends_(e1, f1), at_ends_(e, f1), first,
                                          second);
    }

    double width(Eigen::Index e) const { return arcs_[e].width; }
    Eigen::Index count() const { return count_; }

private:
    Eigen::Index count_;
    std::vector<Arc> arcs_;
    Eigen::ArrayXd x_, y_;
    EndDifferences at_ends_;
};

/// The Galerkin matrix of |d/d theta| on hat functions.
MatrixXd of_hats(Arcs& arcs)
{
    const Eigen::Index m = arcs.count();
    MatrixXd w(m, m);
    for (Eigen::Index f = 0; f < m; ++f)
        for (Eigen::Index e = f; e < m; ++e) w(e, f) = w(f, e) = -arcs.mean_log(e, f) / pi;

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

constexpr double widest = 1.0;  // rad: widest arc for which the corrections count in full

/// S' T S. Row of S at a node: u - (d_- d_+ / 12) u'' by divided differences. The diagonal is at most 7/6, so that S is
/// diagonally dominant.
MatrixXd of_sharpened(const MatrixXd& t, const Arcs& arcs)
{
    const Eigen::Index m = arcs.count();
    const auto before = [&](Eigen::Index a) { return a == 0 ? m - 1 : a - 1; };
    const auto after = [&](Eigen::Index a) { return a + 1 < m ? a + 1 : 0; };
    VectorXd to_last(m), to_next(m);  // S(a, a - 1) and S(a, a + 1), with the diagonal of sum 1
    for (Eigen::Index a = 0; a < m; ++a) {
        const double last = arcs.width(before(a)), next = arcs.width(a);
        const double share = std::min(1.0, widest / (0.5 * (last + next))) / (6.0 * (last + next));
        to_last[a] = -share * next;
        to_next[a] = -share * last;
    }
    const auto times_s = [&](const MatrixXd& matrix) {
        MatrixXd result(m, m);
        for (Eigen::Index a = 0; a < m; ++a)
            result.col(a) = (1.0 - to_last[a] - to_next[a]) * matrix.col(a) +
                            to_next[before(a)] * matrix.col(before(a)) + to_last[after(a)] * matrix.col(after(a));
        return result;
    };
    const MatrixXd result = times_s(times_s(t).transpose());
    return 0.5 * (result + result.transpose());
}

/// Subtracts the segments between circle and polygon. Over each arc a segment has mean height d^2 / 12, and |grad U|^2
/// in it is about twice the squared slope along the arc. Up to `widest` that is at most 0.62 of t, so t stays positive.
void take_off_segments(MatrixXd& t, const Arcs& arcs)
{
    for (Eigen::Index a = 0; a < arcs.count(); ++a) {
        const Eigen::Index b = a + 1 < arcs.count() ? a + 1 : 0;
        const double segment = std::min(arcs.width(a), widest) / 6.0;
        t(a, a) -= segment;
        t(b, b) -= segment;
        t(a, b) += segment;
        t(b, a) += segment;
    }
}

}  // namespace

double clausen_cosine_3(double t)
{
    static const std::array<double, series_length> coefficient = series_coefficients();
    if (std::abs(t) > pi) t = std::remainder(t, 2.0 * pi);
    const double t2 = t * t;
    double tail = 0.0;
    for (int j = series_length - 1; j >= 0; --j) tail = (tail + coefficient[j]) * t2;
    return zeta_3 + second_antiderivative_of_log(t) - tail * t2;
}

MatrixXd disk_dirichlet_to_neumann(const VectorXd& angles)
{
    Arcs arcs(angles);
    MatrixXd t = of_hats(arcs);
    if (arcs.count() > 2) t = of_sharpened(t, arcs);
    take_off_segments(t, arcs);
    return t;
}

CoarseDisk coarse_disk(const VectorXd& angles, const std::vector<std::vector<Index>>& places)
{
    const Eigen::Index m = angles.size(), n = static_cast<Eigen::Index>(places.size());
    const double spacing = static_cast<double>(m) / static_cast<double>(n);
    const auto arc = [&](Eigen::Index i) {
        return i + 1 < m ? angles[i + 1] - angles[i] : angles[0] + 2.0 * pi - angles[i];
    };
    // The means, and their angles: angles are unrolled from each mean's first node on.
    CoarseDisk result;
    VectorXd middles(n);
    for (Eigen::Index c = 0; c < n; ++c) {
        const std::vector<Index>& own = places[static_cast<std::size_t>(c)];
        VectorXd weights(static_cast<Eigen::Index>(own.size()));
        double sum = 0.0;
        for (Eigen::Index j = 0; j < weights.size(); ++j) {
            const Index i = own[static_cast<std::size_t>(j)];
            double away = std::abs(static_cast<double>(i) - static_cast<double>(c) * spacing);
            away = std::min(away, static_cast<double>(m) - away);
            weights[j] = std::max(1.0 - away / spacing, 0.0) * 0.5 * (arc(i) + arc(i > 0 ? i - 1 : m - 1));
            const double turn = i < own.front() ? 2.0 * pi : 0.0;
            sum += weights[j] * (angles[i] + turn);
        }
        middles[c] = sum / weights.sum() - (own.front() > own.back() && c == 0 ? 2.0 * pi : 0.0);
        result.means.emplace_back(weights / weights.sum());
    }
    result.stiffness = disk_dirichlet_to_neumann(middles);
    // The energy of exp(i theta): 2 pi of the disk, less the segments outside of the polygon.
    double exact = 2.0 * pi;
    for (Eigen::Index i = 0; i < m; ++i) exact -= std::min(arc(i), widest) * (2.0 - 2.0 * std::cos(arc(i))) / 6.0;
    VectorXcd mode(n);
    for (Eigen::Index c = 0; c < n; ++c) {
        Complex sum = 0.0;
        for (Eigen::Index j = 0; j < result.means[static_cast<std::size_t>(c)].size(); ++j)
            sum += result.means[static_cast<std::size_t>(c)][j] *
                   std::polar(1.0, angles[places[static_cast<std::size_t>(c)][static_cast<std::size_t>(j)]]);
        mode[c] = sum;
    }
    result.stiffness *= exact / (mode.dot(result.stiffness * mode)).real();
    return result;
}

}  // namespace koebe
