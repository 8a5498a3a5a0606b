#include "certified/circle_bounds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace koebe {
namespace {

constexpr double room_for_rounding = 1e-12;  // in the unit disk

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
    const std::size_t count = circles.size(), b = part.circle;
    const double stretch = part.stretch;
    on.ratio.resize(count);
    on.logarithm.resize(count);
    const double radius = circles[b].radius + slack.of_radii[b];
    const double moved = speed.of_centers[b] + stretch * speed.of_radii[b];
    on.ratio[0] =
        b == 0 ? BoundedFunction{stretch}
               : BoundedFunction{std::abs(circles[b].center) + slack.of_centers[b] + stretch * radius, moved, 0.0};
    for (std::size_t k = 1; k < count; ++k) {
        const double slack_k = slack.of_radii[k], speed_k = speed.of_radii[k];
        if (k == b) {
            const double least = circles[k].radius - slack_k;
            if (!(least > 0.0)) return {};
            on.ratio[k] = {stretch};  // exp(-i angle), wherever the circle is
            on.logarithm[k] = {std::abs(std::log(least)) + 1e-12, speed_k / least, speed_k * speed_k / (least * least)};
            continue;
        }
        const double apart = std::abs(circles[b].center - circles[k].center);
        const double loose = slack.of_centers[b] + slack.of_centers[k] + 1e-15;
        double least = b == 0 ? 1.0 / stretch - apart - loose : apart - loose - stretch * radius;
        if (part.point)
            least = std::abs(*part.point - circles[k].center) - loose - slack.of_radii[b] - part.neighbourhood * radius;
        const double most = b == 0 ? 1.0 + stretch * (apart + loose) : apart + loose + stretch * radius;
        if (!(least > 0.0)) return {};
        on.nearest = std::min(on.nearest, least);
        const double relative = (moved + speed.of_centers[k]) / least;
        // On the unit circle |z - c| is |1 - c / z|, whose logarithm has one value outside |c|.
        const double lowest = b == 0 ? 1.0 - stretch * (apart + loose) : least;
        const double angle = stretch > 1.0 ? std::numbers::pi : 0.0;
        on.logarithm[k] = {std::max(std::abs(std::log(lowest)), std::abs(std::log(most))) + angle, relative,
                           relative * relative};
        on.ratio[k] = BoundedFunction{circles[k].radius + slack_k, speed_k, 0.0} *
                      BoundedFunction{1.0 / least, relative / least, 2.0 * relative * relative / least};
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
