#include "flatten/page_turn.h"

#include "planar/convex_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace koebe {
namespace {

constexpr double quarter = 0.5 * std::numbers::pi;

/// A convex polygon that is turned about 0.
class TurningHull {
public:
    explicit TurningHull(const PlanarPoints& points)
    {
        for (const Eigen::Index i : convex_hull(points)) corners_.emplace_back(points(i, 0), points(i, 1));
    }

    /// Angles from 0 to a quarter turn at which a side lies along an axis, with both ends, rising.
    std::vector<double> critical_angles() const
    {
        std::vector<double> angles{0.0, quarter};
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            const double angle = std::fmod(-std::arg(corners_[(i + 1) % corners_.size()] - corners_[i]), quarter);
            angles.push_back(angle < 0.0 ? angle + quarter : angle);
        }
        std::ranges::sort(angles);
        return angles;
    }

    /// From the leftmost corner at a turn to the rightmost one, before the turn. @param side 0 or 1: of the rectangle,
    /// the search for the corners starts where it ended last
    Complex diameter(double angle, int side)
    {
        const Complex turn = std::polar(1.0, angle);
        return corners_[climb(turn, last_[side][0])] - corners_[climb(-turn, last_[side][1])];
    }

    double width(double angle) { return (std::polar(1.0, angle) * diameter(angle, 0)).real(); }
    double height(double angle) { return (std::polar(1.0, angle + quarter) * diameter(angle + quarter, 1)).real(); }
    bool empty() const { return corners_.empty(); }

private:
    /// The corner that is farthest along the real axis after a turn: on a convex polygon no other one is higher than
    /// both its neighbours.
    std::size_t climb(Complex turn, std::size_t& at) const
    {
        const std::size_t n = corners_.size();
        const auto reach = [&](std::size_t i) { return (turn * corners_[i]).real(); };
        for (const std::size_t way : {std::size_t{1}, n - 1})
            for (std::size_t next = (at + way) % n; reach(next) > reach(at); next = (at + way) % n) at = next;
        return at;
    }

    std::vector<Complex> corners_;
    std::array<std::array<std::size_t, 2>, 2> last_{};
};

/// Adds the angles between two others at which a vector, turned by them, is so long along the real axis.
void add_roots(Complex way, double length, double from, double to, std::vector<double>& angles)
{
    if (!(std::abs(way) > length)) return;
    const double spread = std::acos(length / std::abs(way));
    for (const double side : {-spread, spread}) {
        const double angle = std::remainder(side - std::arg(way) - from, 2.0 * std::numbers::pi);
        if (angle > 0.0 && angle < to - from) angles.push_back(from + angle);
    }
}

}  // namespace

std::optional<Complex> turn_into(const PlanarPoints& points, double width, double height)
{
    if (!(width > 0.0 && height > 0.0) || points.rows() == 0) return {};
    TurningHull hull(points);
    if (hull.empty()) return {};
    const std::vector<double> critical = hull.critical_angles();
    double best = -page_slack;
    std::optional<Complex> found;
    for (int side = 0; side < 2; ++side) {  // the rectangle upright, and along
        const double wide = side == 0 ? width : height, high = side == 0 ? height : width;
        for (std::size_t i = 0; i + 1 < critical.size(); ++i) {
            // between two critical angles the supporting corners stay the same: found in the middle
            const double from = critical[i], to = critical[i + 1], middle = 0.5 * (from + to);
            std::vector<double> angles{from, to};
            add_roots(hull.diameter(middle, 0), wide, from, to, angles);
            add_roots(Complex(0.0, 1.0) * hull.diameter(middle + quarter, 1), high, from, to, angles);
            for (const double angle : angles) {
                const double room = std::min(1.0 - hull.width(angle) / wide, 1.0 - hull.height(angle) / high);
                if (room < best) continue;
                best = room;
                found = std::polar(1.0, angle + (side == 0 ? 0.0 : quarter));
            }
        }
    }
    return found;
}

}  // namespace koebe
