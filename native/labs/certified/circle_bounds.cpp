#include "certified/circle_bounds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace koebe {
namespace {

constexpr double room_for_rounding = 1e-12;  // in the unit disk
constexpr double least_kept = 0.5;           // of each radius and gap, in a step
constexpr int most_halvings = 60;

/// The radii of the inner circles, the gaps between them, and those to the unit circle.
VectorXd radii_and_gaps(const std::vector<Circle>& circles)
{
    std::vector<double> lengths;
    for (std::size_t i = 1; i < circles.size(); ++i) {
        lengths.push_back(circles[i].radius);
        lengths.push_back(1.0 - std::abs(circles[i].center) - circles[i].radius);
        for (std::size_t j = 1; j < i; ++j)
            lengths.push_back(std::abs(circles[i].center - circles[j].center) - circles[i].radius - circles[j].radius);
    }
    return Eigen::Map<VectorXd>(lengths.data(), static_cast<Eigen::Index>(lengths.size()));
}

}  // namespace

CircleStep step_of(Eigen::Index number)
{
    if (number == 0) return {1, 0.0, 1.0};
    if (number < 3) return number == 1 ? CircleStep{2, {0.0, 1.0}, 0.0} : CircleStep{2, 0.0, 1.0};
    const int circle = static_cast<int>(number / 3) + 2;
    const CircleStep steps[3] = {{circle, 1.0, 0.0}, {circle, {0.0, 1.0}, 0.0}, {circle, 0.0, 1.0}};
    return steps[number % 3];
}

std::vector<Circle> circles_of_module(const VectorXd& module)
{
    std::vector<Circle> circles(static_cast<std::size_t>(module.size() + 6) / 3);
    for (std::size_t k = 1; k < circles.size(); ++k) circles[k].radius = 0.0;
    for (Eigen::Index l = 0; l < module.size(); ++l) {
        const CircleStep step = step_of(l);
        circles[step.circle].center += step.center * module[l];
        circles[step.circle].radius += step.radius * module[l];
    }
    return circles;
}

VectorXd moved_module(const VectorXd& module, VectorXd step)
{
    const VectorXd least = least_kept * radii_and_gaps(circles_of_module(module));
    for (int i = 0; i < most_halvings; ++i, step *= 0.5)
        if ((radii_and_gaps(circles_of_module(module + step)).array() >= least.array()).all()) break;
    return module + step;
}

CircleMotion::CircleMotion(const VectorXd& numbers) : of_centers((numbers.size() + 6) / 3, 0.0), of_radii(of_centers)
{
    std::vector<double> squares(of_centers.size(), 0.0);
    for (Eigen::Index l = 0; l < numbers.size(); ++l) {
        const CircleStep step = step_of(l);
        squares[step.circle] += std::norm(step.center) * numbers[l] * numbers[l];
        of_radii[step.circle] += step.radius * numbers[l];
    }
    for (std::size_t k = 0; k < squares.size(); ++k) of_centers[k] = std::sqrt(squares[k]) * rounded_up;
}

OnCircle bounds_on(const std::vector<Circle>& circles, const CirclePart& part, const CircleMotion& slack,
                   const CircleMotion& speed)
{
    OnCircle on;
    const std::size_t b = part.circle;
    const double stretch = part.stretch;
    const double radius = circles[b].radius + slack.of_radii[b];
    const double moved = speed.of_centers[b] + stretch * speed.of_radii[b];
    const BoundedFunction z{std::abs(circles[b].center) + slack.of_centers[b] + stretch * radius, moved, 0.0};
    // z is at most so far from here.
    const Complex here = part.point.value_or(circles[b].center);
    const double reach =
        slack.of_centers[b] + (part.point ? slack.of_radii[b] + part.neighbourhood * radius : stretch * radius);
    // Logarithms of functions without zeros have branches with angles of at most pi.
    const double angle = stretch > 1.0 ? std::numbers::pi : 0.0;
    for (std::size_t k = 1; k < circles.size(); ++k) {
        const double slack_k = slack.of_radii[k], speed_k = speed.of_radii[k];
        const BoundedFunction radius_k{circles[k].radius + slack_k, speed_k, 0.0};

        // r / (z - c)
        if (k == b) {
            const double least = circles[k].radius - slack_k;
            if (!(least > 0.0)) return {};
            on.ratio.push_back({stretch});  // exp(-i angle), wherever the circle is
            on.logarithm.push_back(
                {std::abs(std::log(least)) + 1e-12, speed_k / least, speed_k * speed_k / (least * least)});
        } else {
            const double apart = std::abs(here - circles[k].center);
            const double loose = reach + slack.of_centers[k] + 1e-14;
            const double least = apart - loose, most = apart + loose;
            if (!(least > 0.0)) return {};
            const double relative = (moved + speed.of_centers[k]) / least;
            on.ratio.push_back(radius_k *
                               BoundedFunction{1.0 / least, relative / least, 2.0 * relative * relative / least});
            on.logarithm.push_back(
                {std::max(std::abs(std::log(least)), std::abs(std::log(most))) + angle, relative, relative * relative});
        }

        // r z / D: D' = -(conj(c') z + conj(c) z'), D'' = -2 conj(c') z'
        const double size = std::abs(circles[k].center), size_k = size + slack.of_centers[k];
        const double at_here = std::abs(1.0 - std::conj(circles[k].center) * here);
        const double loose = size * reach + slack.of_centers[k] * z.value + 1e-14;
        const double least = at_here - loose, most = at_here + loose;
        if (!(least > 0.0)) return {};
        const double relative = (speed.of_centers[k] * z.value + size_k * moved) / least;
        const double bend = 2.0 * speed.of_centers[k] * moved / least;
        on.mirrored.push_back(
            radius_k * z * BoundedFunction{1.0 / least, relative / least, (2.0 * relative * relative + bend) / least});
        on.logarithm.back() =
            on.logarithm.back() + BoundedFunction{std::max(std::abs(std::log(least)), std::abs(std::log(most))) + angle,
                                                  relative, relative * relative + bend};
    }
    return on;
}

bool stay_apart(const std::vector<Circle>& circles, const CircleMotion& slack)
{
    for (std::size_t i = 1; i < circles.size(); ++i) {
        const double reach = circles[i].radius + slack.of_radii[i] + slack.of_centers[i] + room_for_rounding;
        if (!(std::abs(circles[i].center) + reach < 1.0)) return false;
        for (std::size_t j = 1; j < i; ++j)
            if (!(std::abs(circles[i].center - circles[j].center) >
                  reach + circles[j].radius + slack.of_radii[j] + slack.of_centers[j]))
                return false;
    }
    return true;
}

}  // namespace koebe
