#include "part_maps/even_pole.h"

#include "circles/moebius.h"
#include "cost/tuning.h"
#include "part_maps/part_map.h"
#include "part_maps/texel_evenness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace koebe {
namespace {

constexpr Eigen::Index most_pole_samples = 350;
constexpr double least_hole = 0.08;     // disk units: turning a map inside out about a smaller hole is never even
constexpr double worth_turning = 0.85;  // of the overflow: another outer loop must bring it below this
constexpr double hopeless_pole = 1.5;   // of the least overflow on the coarse grid: a worse pole is not refined
constexpr double most_radius = 0.98;    // of 1 / pole

/// |1 - conj(a) z|^2 for each z, without hypot.
VectorXd pole_distance(const VectorXcd& z, Complex a)
{
    return (1.0 - 2.0 * (a.real() * z.real().array() + a.imag() * z.imag().array()) + std::norm(a) * z.array().abs2())
        .max(std::numeric_limits<double>::min());
}

class PoleSearch {
public:
    explicit PoleSearch(const MapSample& sample) : sample_(sample) { look_at(0.0); }

    void look_on_grid(std::initializer_list<double> radii, int around)
    {
        for (const double radius : radii)
            for (int k = 0; k < around; ++k) look_at(std::polar(radius, 2.0 * std::numbers::pi * k / around));
    }
    void refine()
    {
        for (double step = 0.12; step > 0.01; step *= 0.5)
            for (int round = 0; round < 2; ++round) {
                const Complex middle = best_;
                const double scale = step * (1.0 - 0.9 * std::abs(middle));
                for (const Complex direction : {Complex(1, 0), Complex(-1, 0), Complex(0, 1), Complex(0, -1)})
                    look_at(middle + scale * direction);
                if (best_ == middle) break;
            }
    }
    Complex best() const { return best_; }
    double least() const { return least_; }

private:
    void look_at(Complex a)
    {
        if (std::abs(a) > most_radius) return;
        const VectorXd u = sample_.u.array() - pole_distance(sample_.centers, a).array().log();
        const double overflow =
            u.allFinite() ? rough_overflow(u, sample_.areas) : tuning::lost_cost * sample_.areas.sum();
        if (overflow >= least_) return;
        least_ = overflow;
        best_ = a;
    }

    const MapSample& sample_;
    Complex best_ = 0.0;
    double least_ = std::numeric_limits<double>::infinity();
};

/// Exchanges the inside and the outside of a loop's circle.
MapSample inside_out(const MapSample& sample, const Circle& circle)
{
    MapSample turned = sample;
    const auto arm = sample.centers.array() - circle.center;
    turned.centers = circle.radius / arm;
    turned.u.array() += std::log(circle.radius) - arm.abs2().max(std::numeric_limits<double>::min()).log();
    return turned;
}

MapSample sampled(const VectorXd& areas, const PartMap& map)
{
    std::vector<Eigen::Index> kept;
    for (Eigen::Index f = 0; f < areas.size(); ++f)
        if (!map.lost[f]) kept.push_back(f);
    const Eigen::Index stride = std::max<Eigen::Index>(1, static_cast<Eigen::Index>(kept.size()) / most_pole_samples);
    std::vector<Eigen::Index> picked;
    for (std::size_t i = 0; i < kept.size(); i += stride) picked.push_back(kept[i]);
    return {map.centers(picked), map.u(picked), areas(picked)};
}

}  // namespace

EvenPole even_pole(const MapSample& sample, const std::vector<Circle>& circles, int outer)
{
    EvenPole pole;
    PoleSearch as_it_is(sample);
    as_it_is.look_on_grid({0.35, 0.65, 0.85, 0.94}, 10);
    as_it_is.refine();
    pole.a = as_it_is.best();
    pole.overflow = as_it_is.least();
    for (std::size_t k = 0; k < circles.size(); ++k) {
        if (static_cast<int>(k) == outer || !(circles[k].radius > least_hole)) continue;
        const MapSample turned = inside_out(sample, circles[k]);
        PoleSearch search(turned);
        search.look_on_grid({0.4, 0.8}, 8);
        if (search.least() > hopeless_pole * pole.overflow) continue;
        search.refine();
        if (!(search.least() < pole.overflow) || !(search.least() < worth_turning * as_it_is.least())) continue;
        pole = {search.best(), static_cast<int>(k), search.least()};
    }
    return pole;
}

MapSample moved(const MapSample& sample, const std::vector<Circle>& circles, const EvenPole& pole)
{
    MapSample result = pole.turned >= 0 ? inside_out(sample, circles[pole.turned]) : sample;
    result.u.array() += std::log(1.0 - std::norm(pole.a)) - pole_distance(result.centers, pole.a).array().log();
    result.centers = Moebius{pole.a, Complex(1.0, 0.0)}(result.centers);
    return result;
}

void move_to_even_pole(const VectorXd& areas, PartMap& map)
{
    const MapSample sample = sampled(areas, map);
    if (sample.u.size() == 0) return;
    const EvenPole pole = even_pole(sample, map.circles, map.outer);
    if (pole.turned >= 0) {
        const Circle& circle = map.circles[pole.turned];
        map.positions = (circle.radius / (map.positions.array() - circle.center)).eval();
        map.outer = pole.turned;
    }
    map.positions = Moebius{pole.a, Complex(1.0, 0.0)}(map.positions);
    MapSample all = moved({std::move(map.centers), std::move(map.u), {}}, map.circles, pole);
    map.centers = std::move(all.centers);
    map.u = std::move(all.u);
}

}  // namespace koebe
