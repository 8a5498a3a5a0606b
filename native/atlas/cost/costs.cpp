#include "cost/costs.h"

#include "even/even_map.h"

namespace koebe {
namespace {

/// 2 / Y.
double compliance(double even)
{
    const double t = area_weight(even);
    return 2.0 * (1.0 + t) / (8.0 * t);
}

}  // namespace

CutPrices prices_of_piece(double area, double price)
{
    using tuning::own_price_area, tuning::small_area;
    const double share = area < small_area ? std::sqrt(small_area / own_price_area) * area / small_area
                                           : std::min(1.0, std::sqrt(area / own_price_area));
    return {share * price, std::min(1.0, share / std::sqrt(area)) * price};
}

double expected_cost(double cost, double part_price)
{
    return cost > 2.0 * part_price ? 2.0 * part_price + tuning::later_share * (cost - 2.0 * part_price) : cost;
}

std::vector<double> cut_prices(const std::vector<double>& show, const std::vector<Index>& vertices)
{
    std::vector<double> prices;
    if (!show.empty())
        for (const Index v : vertices) prices.push_back(1.0 + (tuning::avoided_factor - 1.0) * show[v]);
    return prices;
}

VectorXd visibility_factors(const VectorXd& seen, const VectorXd& areas)
{
    const double mean = tuning::least_seen + seen.dot(areas) / areas.sum();
    return (tuning::least_seen + seen.array()) / mean;
}

VectorXd detail_factors(const VectorXd& density, const VectorXd& areas)
{
    const VectorXd fineness = density.cwiseMax(0.0).cwiseSqrt();
    const double mean = std::max(fineness.dot(areas) / areas.sum(), std::numeric_limits<double>::min());
    return (fineness / mean).cwiseMax(1.0).cwiseMin(tuning::most_detailed);
}

double crack_energy(double pull, double even) { return compliance(even) * pull * pull; }

double beam_energy(Complex force, double moment, double length, double even)
{
    return compliance(even) * (std::norm(force) + 12.0 * moment * moment / (length * length));
}

}  // namespace koebe
