#include "shape/domain_alignment.h"

#include "core/errors.h"
#include "core/numbering.h"
#include "shape/conformal_module.h"
#include "shape/loop_matching.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace koebe {
namespace {

constexpr int most_iterations = 100;
constexpr double difference_step = 1e-6;  // for derivatives, dimensionless
constexpr double least_step = 1e-13;      // smaller steps of the parameters have converged, dimensionless
constexpr double first_damping = 1e-6, most_damping = 1e6;
constexpr std::size_t starting_loops = 4;  // number of first holes whose pairs are starts

using Parameters = Eigen::Vector3d;  ///< a small automorphism: re a, im a, angle

Moebius small_map(const Parameters& p) { return {Complex(p[0], p[1]), std::polar(1.0, p[2])}; }

/// (3n) differences of centres and radii.
VectorXd differences(const std::vector<Circle>& source, const std::vector<Circle>& target, const Moebius& map)
{
    VectorXd result(3 * (source.size() - 1));
    for (std::size_t k = 1; k < source.size(); ++k) {
        const Circle image = map(target[k]);
        const Complex apart = image.center - source[k].center;
        result.segment<3>(3 * (k - 1)) << apart.real(), apart.imag(), image.radius - source[k].radius;
    }
    return result;
}

struct Fit {
    Moebius map;
    double squares = 0.0;
    int iterations = 0;
    bool converged = false;
};

/// Levenberg's method from one start.
Fit improve(const std::vector<Circle>& source, const std::vector<Circle>& target, const Moebius& start,
            const ExecutionContext& context)
{
    Fit fit{start};
    VectorXd now = differences(source, target, fit.map);
    fit.squares = now.squaredNorm();
    double damping = first_damping;
    while (fit.iterations < most_iterations && !fit.converged) {
        context.checkpoint();
        ++fit.iterations;
        MatrixXd slope(now.size(), 3);
        for (int c = 0; c < 3; ++c) {
            const Parameters h = difference_step * Parameters::Unit(c);
            slope.col(c) = (differences(source, target, small_map(h) * fit.map) -
                            differences(source, target, small_map(-h) * fit.map)) /
                           (2.0 * difference_step);
        }
        const Eigen::Matrix3d normal = slope.transpose() * slope;
        bool better = false;
        while (!better && damping < most_damping) {
            const Parameters step =
                -(normal + damping * Eigen::Matrix3d::Identity()).ldlt().solve(slope.transpose() * now);
            const bool inside = step.head<2>().norm() < 1.0;
            const Moebius next = inside ? small_map(step) * fit.map : fit.map;
            const VectorXd there = differences(source, target, next);
            if (step.norm() < least_step) fit.converged = true;
            if (inside && there.squaredNorm() < fit.squares) {
                better = true;
                fit.map = next;
                fit.squares = there.squaredNorm();
                now = there;
                damping *= 0.1;
            } else if (fit.converged) {
                break;
            } else {
                damping *= 10.0;
            }
        }
        // No step lowers the sum in its last digit.
        if (!better) fit.converged = true;
    }
    return fit;
}

/// These loops of a domain as 0, 1, 2.
std::vector<Circle> chosen(const std::vector<Circle>& circles, std::initializer_list<std::size_t> numbers)
{
    return values_at(circles, numbers);
}

std::vector<Moebius> starts(const std::vector<Circle>& source, const std::vector<Circle>& target,
                            std::vector<std::size_t> largest)
{
    const auto start = [&](std::initializer_list<std::size_t> loops) {
        return normalizing_map(chosen(source, loops)).inverse() * normalizing_map(chosen(target, loops));
    };
    if (largest.size() == 1) return {start({0, largest[0]})};
    largest.resize(std::min(largest.size(), starting_loops));
    std::vector<Moebius> maps;
    for (const std::size_t i : largest)
        for (const std::size_t j : largest)
            if (i != j) maps.push_back(start({0, i, j}));
    return maps;
}

}  // namespace

DomainAlignment align_domains(const std::vector<Circle>& source, const std::vector<Circle>& target,
                              std::vector<int> match, const ExecutionContext& context)
{
    DomainAlignment result;
    // The corresponding loops, as given or by the least distance of the modules.
    if (match.empty()) {
        const LoopMatch found = match_loops(source, target, false, context);
        result.margin = found.margin;
        match.resize(source.size());
        for (std::size_t i = 0; i < source.size(); ++i) match[found.order_a[i]] = found.order_b[i];
    } else {
        require_circle_domain(source);
        require_circle_domain(target);
        std::vector<int> natural = numbers_below<int>(source.size());
        if (target.size() != source.size() || match[0] != 0 ||
            !std::is_permutation(natural.begin(), natural.end(), match.begin(), match.end()))
            throw InputError("the match must name each of the target's loops once, the outer one first");
    }
    std::vector<Circle> matched;
    for (const int k : match) matched.push_back(target[k]);
    result.match = std::move(match);
    result.misses.assign(source.size(), 0.0);
    if (source.size() == 1) return result;

    // The loops nearest to the outer one tell most: exact maps of these start the fit of all.
    std::vector<std::size_t> largest(source.size() - 1);
    std::iota(largest.begin(), largest.end(), std::size_t{1});
    std::ranges::stable_sort(largest, {}, [&](std::size_t k) {
        return conformal_separation(source[0], source[k]) + conformal_separation(matched[0], matched[k]);
    });
    Fit best;
    best.squares = std::numeric_limits<double>::infinity();
    for (const Moebius& start : starts(source, matched, largest))
        if (const Fit fit = improve(source, matched, start, context); fit.squares < best.squares) best = fit;

    // The misses of all loops but the outer one.
    const VectorXd left = differences(source, matched, best.map);
    result.map = best.map;
    result.iterations = best.iterations;
    result.converged = best.converged;
    result.residual = std::sqrt(left.squaredNorm() / static_cast<double>(source.size() - 1));
    for (Eigen::Index k = 0; 3 * k < left.size(); ++k) result.misses[k + 1] = left.segment<3>(3 * k).norm();
    const auto worst = std::max_element(result.misses.begin() + 1, result.misses.end());
    result.largest = *worst;
    result.worst = static_cast<int>(worst - result.misses.begin());
    return result;
}

}  // namespace koebe
