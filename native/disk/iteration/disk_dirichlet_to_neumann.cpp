#include "iteration/disk_dirichlet_to_neumann.h"

#include <Eigen/SparseCholesky>

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

/// The remainder by 2 pi nearest to 0. Exact: std::remainder, which takes as long as a logarithm, is for far angles.
double wrapped_angle(double t)
{
    if (std::abs(t) <= pi) return t;
    if (std::abs(t) < 2.5 * pi) return t - std::copysign(2.0 * pi, t);
    return std::remainder(t, 2.0 * pi);
}

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
        const double t = wrapped_angle(arcs_[e].middle - arcs_[f].middle);
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

/// The correction of hat functions at a node between arcs of these widths: times u'', by of_sharpened.
double hat_correction(double last, double next)
{
    return std::min(1.0, widest / (0.5 * (last + next))) * last * next / 12.0;
}

/// S' T S. Row of S at a node: u - amount u'' by divided differences.
/// @param amount of a node between arcs of these widths, (their product) / 6 at most: S is diagonally dominant then
template <typename Amount>
MatrixXd of_sharpened(const MatrixXd& t, const Arcs& arcs, Amount&& amount)
{
    const Eigen::Index m = arcs.count();
    const auto before = [&](Eigen::Index a) { return a == 0 ? m - 1 : a - 1; };
    const auto after = [&](Eigen::Index a) { return a + 1 < m ? a + 1 : 0; };
    VectorXd to_last(m), to_next(m);  // S(a, a - 1) and S(a, a + 1), with the diagonal of sum 1
    for (Eigen::Index a = 0; a < m; ++a) {
        const double last = arcs.width(before(a)), next = arcs.width(a);
        const double share = 2.0 * amount(a, last, next) / (last + next);
        to_last[a] = -share / last;
        to_next[a] = -share / next;
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
/// @param segments over each arc: their factor of the squared difference of its ends, d / 6 for one segment
void take_off_segments(MatrixXd& t, const VectorXd& segments)
{
    for (Eigen::Index a = 0; a < segments.size(); ++a) {
        const Eigen::Index b = a + 1 < segments.size() ? a + 1 : 0;
        t(a, a) -= segments[a];
        t(b, b) -= segments[a];
        t(a, b) += segments[a];
        t(b, a) += segments[a];
    }
}

double segment(double arc) { return std::min(arc, widest) / 6.0; }

}  // namespace

double clausen_cosine_3(double t)
{
    static const std::array<double, series_length> coefficient = series_coefficients();
    t = wrapped_angle(t);
    const double t2 = t * t;
    double tail = 0.0;
    for (int j = series_length - 1; j >= 0; --j) tail = (tail + coefficient[j]) * t2;
    return zeta_3 + second_antiderivative_of_log(t) - tail * t2;
}

MatrixXd disk_dirichlet_to_neumann(const VectorXd& angles)
{
    Arcs arcs(angles);
    MatrixXd t = of_hats(arcs);
    if (arcs.count() > 2)
        t = of_sharpened(t, arcs, [](Eigen::Index, double last, double next) { return hat_correction(last, next); });
    VectorXd segments(arcs.count());
    for (Eigen::Index a = 0; a < arcs.count(); ++a) segments[a] = segment(arcs.width(a));
    take_off_segments(t, segments);
    return t;
}

CoarseDisk coarse_disk(const VectorXd& angles, const std::vector<std::vector<Index>>& places)
{
    const Eigen::Index m = angles.size(), n = static_cast<Eigen::Index>(places.size());
    const auto arc = [&](Eigen::Index i) {
        return i + 1 < m ? angles[i + 1] - angles[i] : angles[0] + 2.0 * pi - angles[i];
    };
    // P: hats at every few vertices, where the places of the mean before end. A: the arc around each vertex.
    VectorXd nodes(n), segments = VectorXd::Zero(n), mass(m);
    std::vector<Eigen::Triplet<double, Index>> hats;
    for (Eigen::Index c = 0; c < n; ++c) {
        const Eigen::Index first = c > 0 ? places[c - 1].back() + 1 : 0, end = places[c].back() + 1;
        nodes[c] = angles[first];
        const double width = (end < m ? angles[end] : angles[0] + 2.0 * pi) - nodes[c];
        for (Eigen::Index i = first; i < end; ++i) {
            const double share = (angles[i] - nodes[c]) / width;
            hats.emplace_back(static_cast<Index>(i), static_cast<Index>(c), 1.0 - share);
            hats.emplace_back(static_cast<Index>(i), static_cast<Index>(c + 1 < n ? c + 1 : 0), share);
            mass[i] = 0.5 * (arc(i) + arc(i > 0 ? i - 1 : m - 1));
            // The polygon is the loop's: with slope s along the wide arc its segments take d_i^3 / 6 s^2 each.
            segments[c] += segment(arc(i)) * std::pow(arc(i) / width, 2);
        }
    }
    SparseMatrix weights(m, n);
    weights.setFromTriplets(hats.begin(), hats.end());
    // The projection to hats is Q = G^-1 P' A with G = P' A P, and P' A is the means times their weights' sums.
    const SparseMatrix transposed = weights.transpose();
    weights = mass.asDiagonal() * weights;
    const Eigen::SimplicialLDLT<SparseMatrix> gram(SparseMatrix(transposed * weights));
    const VectorXd sums = weights.transpose() * VectorXd::Ones(m);
    CoarseDisk result;
    for (Eigen::Index c = 0; c < n; ++c) {
        const std::vector<Index>& own = places[static_cast<std::size_t>(c)];
        VectorXd& mean = result.means.emplace_back(static_cast<Eigen::Index>(own.size()));
        for (Eigen::Index j = 0; j < mean.size(); ++j)
            mean[j] = weights.coeff(own[static_cast<std::size_t>(j)], static_cast<Index>(c)) / sums[c];
    }
    // Q u = u + e u'' at the nodes, where exp(i theta) tells e. It nearly cancels the error of hat functions.
    MatrixXd parts(m, 2);
    parts << angles.array().cos(), angles.array().sin();
    const MatrixXd mode = gram.solve(MatrixXd(weights.transpose() * parts));
    Arcs arcs(nodes);
    MatrixXd t = of_sharpened(of_hats(arcs), arcs, [&](Eigen::Index c, double last, double next) {
        const double e = 1.0 - std::cos(nodes[c]) * mode(c, 0) - std::sin(nodes[c]) * mode(c, 1);
        return std::clamp(hat_correction(last, next) + e, 0.0, last * next / 6.0);
    });
    take_off_segments(t, segments);
    // The energy of exp(i theta): 2 pi of the disk, less the segments outside of the polygon.
    double exact = 2.0 * pi;
    for (Eigen::Index i = 0; i < m; ++i) exact -= segment(arc(i)) * (2.0 - 2.0 * std::cos(arc(i)));
    t *= exact / (mode.transpose() * t * mode).trace();
    t = gram.solve(MatrixXd(gram.solve(t).transpose()));
    t = sums.asDiagonal() * t * sums.asDiagonal();
    result.stiffness = 0.5 * (t + t.transpose());
    return result;
}

}  // namespace koebe
