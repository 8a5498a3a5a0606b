#include "part_maps/texel_evenness.h"

#include "cost/costs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace koebe {
namespace {

using Density = std::pair<double, double>;  // u and area of a face

/// The faces that are not lost, by u.
std::vector<Density> by_density(const VectorXd& u, const VectorXd& areas, const std::vector<char>& lost)
{
    std::vector<Density> order;
    order.reserve(static_cast<std::size_t>(u.size()));
    for (Eigen::Index f = 0; f < u.size(); ++f)
        if (lost.empty() || !lost[f]) order.emplace_back(u[f], areas[f]);
    std::sort(order.begin(), order.end());
    return order;
}

}  // namespace

Evenness evenness(const VectorXd& u, const VectorXd& areas, const std::vector<char>& lost)
{
    Evenness result;
    const std::vector<Density> order = by_density(u, areas, lost);
    const auto count = static_cast<Eigen::Index>(order.size());
    double known = 0.0;
    for (const Density& face : order) known += face.second;
    result.overflow = lost.empty() ? 0.0 : tuning::lost_cost * std::max(areas.sum() - known, 0.0);
    if (count == 0) return result;

    // The overflow's slope in `from` is area below less area above: walk through the places where it changes.
    Eigen::Index low = 0, high = 0;
    double below = 0.0, above = known;
    double least = 0.0, most = 0.0;  // where the slope is 0
    bool found = false;
    while (low < count) {
        const double next_low = order[low].first;
        const double next_high =
            high < count ? order[high].first - tuning::even_range : std::numeric_limits<double>::infinity();
        double at;
        if (next_high <= next_low) {
            at = next_high;
            above -= order[high++].second;
        } else {
            at = next_low;
            below += order[low++].second;
        }
        if (!found && below - above >= 0.0) {
            least = most = at;
            found = true;
            if (below - above > 0.0) break;
        } else if (found) {
            most = at;
            if (below - above > 0.0) break;
        }
    }
    result.from = 0.5 * (least + most);
    for (const auto& [at, area] : order) {
        const double off = off_window(at, result.from);
        result.overflow += area * uneven_cost(off);
        if (off == 0.0) result.inside += area;
    }
    return result;
}

double rough_overflow(const VectorXd& u, const VectorXd& areas)
{
    constexpr int bins = 128;
    constexpr int width = 24;  // bins of even_range
    constexpr double step = tuning::even_range / width;
    const double middle = u.dot(areas) / areas.sum(), low = middle - 0.5 * bins * step;
    std::array<double, bins + 1> area{}, moment{};  // of all bins below; moment in steps from low
    constexpr double per_step = 1.0 / step;
    double beyond = 0.0;  // cost beyond the ends of the histogram
    for (Eigen::Index f = 0; f < u.size(); ++f) {
        const double at = (u[f] - low) * per_step;
        const double held = std::clamp(at, 0.0, bins - 1e-9);
        beyond += areas[f] * uneven_cost(std::abs(at - held) * step);
        const auto bin = static_cast<std::size_t>(held);
        area[bin + 1] += areas[f];
        moment[bin + 1] += areas[f] * held;
    }
    for (int b = 0; b < bins; ++b) {
        area[b + 1] += area[b];
        moment[b + 1] += moment[b];
    }
    double least = std::numeric_limits<double>::infinity();
    for (int from = 0; from + width <= bins; ++from) {
        const int until = from + width;
        const double below = area[from] * from - moment[from];
        const double above = moment[bins] - moment[until] - (area[bins] - area[until]) * until;
        least = std::min(least, below + above);
    }
    return least * step + beyond;
}

}  // namespace koebe
