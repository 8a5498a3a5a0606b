#include "parts/evenness.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace koebe {
namespace {

constexpr double cap = 6.0;  // of a face's distance to the window, in u

}  // namespace

Evenness evenness(const VectorXd& u, const VectorXd& areas)
{
    Evenness result;
    const Eigen::Index count = u.size();
    if (count == 0) return result;
    std::vector<Eigen::Index> order(count);
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return u[a] < u[b]; });

    // The overflow's slope in `from` is area below less area above: walk through the places where it changes.
    Eigen::Index low = 0, high = 0;
    double below = 0.0, above = areas.sum();
    double least = 0.0, most = 0.0;  // where the slope is 0
    bool found = false;
    while (low < count) {
        const double next_low = u[order[low]];
        const double next_high = high < count ? u[order[high]] - even_range : std::numeric_limits<double>::infinity();
        double at;
        if (next_high <= next_low) {
            at = next_high;
            above -= areas[order[high++]];
        } else {
            at = next_low;
            below += areas[order[low++]];
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
    for (Eigen::Index f = 0; f < count; ++f) {
        const double distance = std::max({result.from - u[f], u[f] - result.from - even_range, 0.0});
        result.overflow += areas[f] * std::min(distance, cap);
        if (distance == 0.0) result.inside += areas[f];
    }
    return result;
}

}  // namespace koebe
