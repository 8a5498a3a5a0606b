#include "circles/circle_projection.h"

#include "circles/on_circle.h"
#include "core/uv_resolution.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace koebe {
namespace {

using std::numbers::pi;

constexpr double rounding = 0x1p-49;    // of a coordinate, relative: some rounding errors of a Moebius map
constexpr double least_of_mean = 1e-3;  // least distance of neighbours over the mean one, dimensionless

/// The nondecreasing sequence nearest to the given one.
VectorXd isotonic(const VectorXd& values)
{
    struct Block {
        double sum;
        Eigen::Index count;
        double mean() const { return sum / static_cast<double>(count); }
    };
    std::vector<Block> blocks;
    for (const double value : values) {
        blocks.push_back({value, 1});
        while (blocks.size() > 1 && blocks[blocks.size() - 2].mean() > blocks.back().mean()) {
            const Block last = blocks.back();
            blocks.pop_back();
            blocks.back().sum += last.sum;
            blocks.back().count += last.count;
        }
    }
    VectorXd result(values.size());
    Eigen::Index i = 0;
    for (const Block& block : blocks) {
        result.segment(i, block.count).setConstant(block.mean());
        i += block.count;
    }
    return result;
}

}  // namespace

bool run_once_round(const VectorXcd& arms, int turn)
{
    double sum = 0.0;
    for (Eigen::Index i = 0; i < arms.size(); ++i) {
        const double step = turn * std::arg(arms[(i + 1) % arms.size()] / arms[i]);
        sum += step >= 0.0 ? step : step + 2.0 * pi;
    }
    return sum < 3.0 * pi;
}

VectorXcd project_onto_circle(const Circle& circle, const VectorXcd& points, int turn, const VectorXd& least_steps)
{
    const Eigen::Index n = points.size();
    VectorXcd arms = points.array() - circle.center;
    for (Complex& arm : arms) arm = std::abs(arm) > 0.0 ? arm / std::abs(arm) : Complex(1.0, 0.0);
    VectorXd steps(n);
    for (Eigen::Index b = 0; b < n; ++b) steps[b] = turn * std::arg(arms[(b + 1) % n] / arms[b]);
    const VectorXd least = least_steps.size() == n
                               ? least_steps
                               : VectorXd::Constant(n, least_of_mean * 2.0 * pi / static_cast<double>(n));
    if ((steps - least).minCoeff() >= 0.0) return circle.center + (circle.radius * arms).array();

    // Cut at the widest step, where the order is certain.
    Eigen::Index widest = 0;
    (steps - least).maxCoeff(&widest);
    const Eigen::Index first = (widest + 1) % n;
    VectorXd angles(n), room = VectorXd::Zero(n);
    double angle = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
        if (i > 0) room[i] = room[i - 1] + least[(first + i - 1) % n];
        angles[i] = angle - room[i];
        angle += steps[(first + i) % n];
    }
    angles = isotonic(angles) + room;
    // If the ends would meet, shrink the excess over the least steps.
    const double span = angles[n - 1] - angles[0], most = 2.0 * pi - least[widest];
    const double scale = span > most ? (most - room[n - 1]) / (span - room[n - 1]) : 1.0;
    angles = (angles.array() - angles[0] - room.array()) * scale + angles[0] + room.array();
    VectorXcd result(n);
    for (Eigen::Index i = 0; i < n; ++i)
        result[(first + i) % n] = circle.center + circle.radius * arms[first] * std::polar(1.0, turn * angles[i]);
    return result;
}

bool is_on_circle(const Circle& circle, Complex point, double tolerance)
{
    const double slack = tolerance * circle.radius + rounding * (std::abs(circle.center) + circle.radius);
    return std::abs(std::abs(point - circle.center) - circle.radius) <= slack;
}

bool is_off_circle(const Circle& circle, Complex point) { return !is_on_circle(circle, point, circle_tolerance); }

}  // namespace koebe
