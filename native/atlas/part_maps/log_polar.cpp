#include "part_maps/log_polar.h"

#include "cost/tuning.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace koebe {
namespace {

constexpr int t_bins = 56, v_bins = 160;
constexpr double least_length = 0.8;  // of t
constexpr double deepest = -40.0;     // of t
constexpr double even_cap = 0.93;     // share of the rest inside, within even_range, to count as even

struct Histogram {
    double t_low = 0.0, t_step = 1.0, v_low = 0.0, v_step = 1.0;
    std::array<std::array<double, v_bins + 1>, t_bins + 1> sums{};  // of all bins below in t, and below in v

    double area(int i, int j, int a, int b) const { return sums[j][b] - sums[i][b] - sums[j][a] + sums[i][a]; }
};

/// @param v of the faces; one that is not finite counts nothing
Histogram histogram(const PartMesh& part, const VectorXd& t, const VectorXd& v)
{
    Histogram result;
    // The range of t and v.
    double t_low = 0.0, v_low = std::numeric_limits<double>::infinity(), v_high = -v_low;
    const auto counts = [&](Eigen::Index f) { return t[f] > deepest && std::isfinite(v[f]); };
    // The area in each bin, in row and column 1 on.
    for (Eigen::Index f = 0; f < t.size(); ++f) {
        if (!counts(f)) continue;
        t_low = std::min(t_low, t[f]);
        v_low = std::min(v_low, v[f]);
        v_high = std::max(v_high, v[f]);
    }
    if (!(v_high > v_low)) v_high = v_low + 1.0;
    result.t_low = t_low;
    result.t_step = std::max(-t_low, 1e-9) / t_bins;
    result.v_low = v_low;
    result.v_step = std::max((v_high - v_low) / v_bins, tuning::even_range / 40.0);
    for (Eigen::Index f = 0; f < t.size(); ++f) {
        if (!counts(f)) continue;
        const int i = std::clamp(static_cast<int>((t[f] - t_low) / result.t_step), 0, t_bins - 1);
        const int a = std::clamp(static_cast<int>((v[f] - v_low) / result.v_step), 0, v_bins - 1);
        result.sums[i + 1][a + 1] += part.areas[f];
    }
    // Sums of the rectangles from the corner: any rectangle is then four look-ups.
    for (int i = 1; i <= t_bins; ++i)
        for (int a = 1; a <= v_bins; ++a)
            result.sums[i][a] += result.sums[i - 1][a] + result.sums[i][a - 1] - result.sums[i - 1][a - 1];
    return result;
}

/// The most area of a range of t within even_range of the other coordinate.
double even_area(const Histogram& bins, int i, int j)
{
    const int width = std::max(1, static_cast<int>(tuning::even_range / bins.v_step));
    double most = 0.0;
    for (int a = 0; a < v_bins; ++a) most = std::max(most, bins.area(i, j, a, std::min(a + width, v_bins)));
    return most;
}

/// The inner end moved out to the first place where the rest inside is an even disk.
int raised_end(const PartMesh& part, const PartMap& map, const LogPolar& polar, const Histogram& tubes, int from,
               int until)
{
    for (const auto& [low, high] : polar.loops)
        if (high < tubes.t_low + until * tubes.t_step) return from;  // loops inside: no cap
    const Histogram disks = histogram(part, polar.t, map.u);
    const int least = static_cast<int>(std::ceil(least_length / tubes.t_step));
    double lost = 0.0;
    for (Eigen::Index f = 0; f < polar.t.size(); ++f)
        if (!(polar.t[f] > deepest)) lost += part.areas[f];
    int end = -1;
    for (int i = from; i <= until - least; ++i) {
        const double area = disks.area(0, i, 0, v_bins) + lost;
        if (area > 0.0 && even_area(disks, 0, i) >= even_cap * area)
            end = i;  // the largest even cap
        else if (end >= 0)
            break;
    }
    return end >= 0 ? end : from;
}

}  // namespace

LogPolar log_polar(const PartMesh& part, const PartMap& map, Complex about, int hole)
{
    LogPolar polar;
    polar.hole = hole;
    constexpr double tiny = std::numeric_limits<double>::min();
    const auto depth = [&](Complex z) {
        return std::log(std::max(std::abs(z - about) / std::abs(1.0 - std::conj(about) * z), 1e-300));
    };
    // With m = (z - c) / (1 - conj(c) z): t = log |m|, and v = u + log |m' / m|, the scale in the plane of log m.
    const VectorXd near = 0.5 * (map.centers.array() - about).abs2().max(tiny).log();
    const VectorXd far = 0.5 * (1.0 - std::conj(about) * map.centers.array()).abs2().max(tiny).log();
    polar.t = near - far;
    polar.v = map.u.array() + std::log(1.0 - std::norm(about)) - near.array() - far.array();
    for (Eigen::Index f = 0; f < polar.t.size(); ++f)
        if (map.lost[f]) polar.t[f] = -std::numeric_limits<double>::infinity();
    // The loops' ranges of t, but for the outer one and the hole in the middle.
    for (std::size_t k = 0; k < part.surface.loops.size(); ++k) {
        if (static_cast<int>(k) == map.outer || static_cast<int>(k) == hole) continue;
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Index v : part.surface.loops[k]) {
            const double t = depth(map.positions[v]);
            low = std::min(low, t);
            high = std::max(high, t);
        }
        polar.loops.emplace_back(low, high);
    }
    return polar;
}

TubeRange longest_tube(const PartMesh& part, const PartMap& map, const LogPolar& polar, double share)
{
    const Histogram bins = histogram(part, polar.t, polar.v);
    const auto at = [&](int i) { return bins.t_low + i * bins.t_step; };
    TubeRange best;
    int best_from = 0, best_until = 0;
    for (int i = 0; i < t_bins; ++i)
        for (int j = t_bins; j > i && at(j) - at(i) >= least_length; --j) {
            const double area = bins.area(i, j, 0, v_bins);
            if (!(area > best.area)) break;  // shorter ones have less
            if (std::ranges::any_of(polar.loops,
                                    [&](const auto& loop) { return loop.second > at(i) && loop.first < at(j); }))
                continue;
            if (even_area(bins, i, j) < share * area) continue;
            best = {at(i), at(j), area};
            best_from = i;
            best_until = j;
        }
    if (!(best.area > 0.0)) return best;
    if (polar.hole < 0) best.from = at(raised_end(part, map, polar, bins, best_from, best_until));
    if (best_until == t_bins) best.until = std::numeric_limits<double>::infinity();
    if (best_from == 0 && best.from == at(0) && polar.hole >= 0) best.from = -std::numeric_limits<double>::infinity();
    return best;
}

}  // namespace koebe
