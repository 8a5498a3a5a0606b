#include "parts/even_pole.h"

#include "circles/moebius.h"
#include "parts/evenness.h"
#include "parts/part_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace koebe {
namespace {

constexpr Eigen::Index most_samples = 350;
constexpr double least_hole = 0.08;     // disk units: to turn a map inside out about a smaller hole is never even
constexpr double worth_turning = 0.85;  // of the overflow, for another loop outside
constexpr double most_radius = 0.98;    // of 1 / pole

struct Samples {
    VectorXcd centers;
    VectorXd u, areas;
};

Samples sampled(const VectorXd& areas, const PartMap& map)
{
    std::vector<Eigen::Index> kept;
    for (Eigen::Index f = 0; f < areas.size(); ++f)
        if (!map.lost[f]) kept.push_back(f);
    const Eigen::Index stride = std::max<Eigen::Index>(1, static_cast<Eigen::Index>(kept.size()) / most_samples);
    std::vector<Eigen::Index> picked;
    for (std::size_t i = 0; i < kept.size(); i += stride) picked.push_back(kept[i]);
    return {map.centers(picked), map.u(picked), areas(picked)};
}

double overflow_with(const Samples& samples, Complex a)
{
    const VectorXd u = samples.u.array() - (1.0 - std::conj(a) * samples.centers.array()).abs2().log();
    return u.allFinite() ? rough_overflow(u, samples.areas) : 6.0 * samples.areas.sum();
}

/// The automorphism of the disk, by the point that goes to 0.
Complex best_point(const Samples& samples, double& least)
{
    Complex best = 0.0;
    least = overflow_with(samples, best);
    const auto look_at = [&](Complex a) {
        if (std::abs(a) > most_radius) return;
        const double overflow = overflow_with(samples, a);
        if (overflow >= least) return;
        least = overflow;
        best = a;
    };
    for (const double radius : {0.35, 0.65, 0.85, 0.94})
        for (int k = 0; k < 10; ++k) look_at(std::polar(radius, 0.2 * std::numbers::pi * k));
    for (double step = 0.12; step > 0.01; step *= 0.5)
        for (int round = 0; round < 2; ++round) {
            const Complex middle = best;
            const double scale = step * (1.0 - 0.9 * std::abs(middle));
            for (const Complex direction : {Complex(1, 0), Complex(-1, 0), Complex(0, 1), Complex(0, -1)})
                look_at(middle + scale * direction);
            if (best == middle) break;
        }
    return best;
}

void turn_inside_out(PartMap& map, int loop)
{
    const Circle circle = map.circles[loop];
    map.positions = circle.radius / (map.positions.array() - circle.center);
    const auto arm = map.centers.array() - circle.center;
    map.u.array() += std::log(circle.radius) - 2.0 * arm.abs().log();
    map.centers = (circle.radius / arm).eval();
    map.outer = loop;
}

}  // namespace

void move_to_even_pole(const VectorXd& areas, PartMap& map)
{
    const Samples samples = sampled(areas, map);
    if (samples.u.size() == 0) return;
    double least = 0.0;
    Complex best = best_point(samples, least);
    const double as_it_is = least;
    int outer = map.outer;
    for (std::size_t k = 0; k < map.circles.size(); ++k) {
        const Circle& circle = map.circles[k];
        if (static_cast<int>(k) == map.outer || !(circle.radius > least_hole)) continue;
        Samples turned = samples;
        const auto arm = samples.centers.array() - circle.center;
        turned.centers = circle.radius / arm;
        turned.u.array() -= 2.0 * arm.abs().log();
        double overflow = 0.0;
        const Complex a = best_point(turned, overflow);
        if (overflow < least && overflow < worth_turning * as_it_is) {
            least = overflow;
            best = a;
            outer = static_cast<int>(k);
        }
    }
    if (outer != map.outer) turn_inside_out(map, outer);
    const Moebius move{best, Complex(1.0, 0.0)};
    map.positions = move(map.positions);
    map.u.array() += std::log(1.0 - std::norm(best)) - 2.0 * (1.0 - std::conj(best) * map.centers.array()).abs().log();
    map.centers = move(map.centers);
}

}  // namespace koebe
