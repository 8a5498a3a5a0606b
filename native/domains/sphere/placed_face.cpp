#include "sphere/placed_face.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace koebe {
namespace {

constexpr double uv_steps = 8388608.0;    // 2^23 per unit: as fine as 32-bit floats between 1 and 2
constexpr double pole_step = 1.0 / 16.0;  // turns: from an edge between both poles to the third corner

bool at_pole(const SpherePoint& p) { return p[0] == 0.0 && p[1] == 0.0; }

/// Longitudes of a face round a pole, in turns: each step goes the shorter way, one step is left out, chosen so that
/// the face is upright.
std::array<double, 3> once_round(const std::array<double, 3>& turns, const std::array<double, 3>& heights, bool turned)
{
    std::array<double, 3> best{};
    double most = -std::numeric_limits<double>::infinity();
    for (std::size_t first = 0; first < 3; ++first) {
        std::array<double, 3> own = turns;
        for (std::size_t k = 1; k < 3; ++k) {
            double& next = own[(first + k) % 3];
            next -= std::round(next - own[(first + k + 2) % 3]);
        }
        const double area =
            (own[1] - own[0]) * (heights[2] - heights[0]) - (own[2] - own[0]) * (heights[1] - heights[0]);
        if ((turned ? -area : area) <= most) continue;
        most = turned ? -area : area;
        best = own;
    }
    return best;
}

PlacedFace equirectangular(const SphereCorners& p, bool turned)
{
    PlacedFace placed;
    std::array<double, 3> turns{};
    std::size_t known = 3;  // a corner with a longitude
    for (std::size_t k = 0; k < 3; ++k) {
        if (at_pole(p[k])) continue;
        double own = on_uv_steps(std::atan2(p[k][1], p[k][0]) / (2.0 * std::numbers::pi) + 0.5);
        if (own >= 1.0) own = 0.0;
        turns[k] = own;
        if (known == 3) known = k;
    }
    for (std::size_t k = 0; k < 3; ++k)
        if (!at_pole(p[k])) turns[k] -= std::round(turns[k] - turns[known]);
    int poles = 0;
    for (std::size_t k = 0; k < 3; ++k) poles += at_pole(p[k]) ? 1 : 0;
    for (std::size_t k = 0; k < 3; ++k) {
        if (!at_pole(p[k])) continue;
        const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
        if (poles == 1) {
            turns[k] = on_uv_steps(0.5 * (turns[a] + turns[b]));
        } else if (known < 3) {  // an edge from pole to pole lies where the face is upright
            const bool rises = p[(known + 2) % 3][2] > 0.0;
            turns[k] = turns[known] + (rises != turned ? pole_step : -pole_step);
        }
    }
    placed.torn = poles == 0 && (face_contains(p, {0.0, 0.0, 1.0}) || face_contains(p, {0.0, 0.0, -1.0}));
    std::array<double, 3> heights{};
    for (std::size_t k = 0; k < 3; ++k)
        heights[k] = on_uv_steps(std::atan2(p[k][2], std::hypot(p[k][0], p[k][1])) / std::numbers::pi + 0.5);
    if (placed.torn) turns = once_round(turns, heights, turned);
    const double back = std::floor(*std::ranges::min_element(turns));
    for (std::size_t k = 0; k < 3; ++k) {
        placed.uv[k] << turns[k] - back, heights[k];
        placed.crossing |= placed.uv[k][0] >= 1.0;
    }
    return placed;
}

/// The place in [-1, 1]^2. @param x, y signs to use where a coordinate is 0
Eigen::RowVector2d folded_out(const SpherePoint& p, double x, double y)
{
    const double sum = std::abs(p[0]) + std::abs(p[1]) + std::abs(p[2]);
    const double a = std::abs(p[0]) / sum, b = std::abs(p[1]) / sum;
    return p[2] >= 0.0 ? Eigen::RowVector2d(x * a, y * b) : Eigen::RowVector2d(x * (1.0 - b), y * (1.0 - a));
}

/// u -> sign u + shift, for both coordinates: a product of the pattern's half turns.
struct FoldedSheet {
    double sign = 1.0;
    Eigen::RowVector2d shift = Eigen::RowVector2d::Zero();

    /// Continues over the side of the square with this middle.
    void cross(const Eigen::RowVector2d& middle)
    {
        shift += sign * 2.0 * middle;
        sign = -sign;
    }
    Eigen::RowVector2d operator()(const Eigen::RowVector2d& at) const { return sign * at + shift; }
};

PlacedFace octahedral(const SphereCorners& p)
{
    PlacedFace placed;
    const SpherePoint middle = p[0] + p[1] + p[2];
    for (std::size_t k = 0; k < 3; ++k) {
        // Follow the straight line from the middle to the corner, over the planes x = 0 and y = 0.
        std::array<double, 2> sign{}, when{};
        for (std::size_t i = 0; i < 2; ++i) {
            const Eigen::Index axis = static_cast<Eigen::Index>(i);
            sign[i] = middle[axis] < 0.0 ? -1.0 : 1.0;
            const bool over = p[k][axis] != 0.0 && (p[k][axis] < 0.0) != (middle[axis] < 0.0);
            when[i] = over ? middle[axis] / (middle[axis] - p[k][axis]) : 2.0;
        }
        FoldedSheet sheet;
        for (const std::size_t i :
             when[0] <= when[1] ? std::array<std::size_t, 2>{0, 1} : std::array<std::size_t, 2>{1, 0}) {
            if (when[i] > 1.0) continue;
            const double height = middle[2] + when[i] * (p[k][2] - middle[2]);
            if (height < 0.0) {  // the lower half: cross the side given by the other coordinate's sign
                Eigen::RowVector2d side(0.0, 0.0);
                side[i == 0 ? 1 : 0] = sign[i == 0 ? 1 : 0];
                sheet.cross(side);
                placed.crossing = true;
            }
            sign[i] = -sign[i];
        }
        const Eigen::RowVector2d at = folded_out(p[k], sign[0], sign[1]);
        placed.uv[k] = sheet(Eigen::RowVector2d(on_uv_steps(0.5 * at[0]) * 2.0, on_uv_steps(0.5 * at[1]) * 2.0));
        placed.uv[k] = (0.5 * (placed.uv[k].array() + 1.0)).matrix();
    }
    for (const SpherePoint& corner :
         {SpherePoint(1, 0, 0), SpherePoint(-1, 0, 0), SpherePoint(0, 1, 0), SpherePoint(0, -1, 0)})
        placed.torn |= std::ranges::find(p, corner) == p.end() && face_contains(p, corner);
    return placed;
}

}  // namespace

double on_uv_steps(double t) { return std::round(t * uv_steps) / uv_steps; }

std::span<const SpherePoint> cone_points(SphereLayout layout)
{
    static const std::array<SpherePoint, 2> poles{SpherePoint(0, 0, 1), SpherePoint(0, 0, -1)};
    static const std::array<SpherePoint, 4> middles{SpherePoint(1, 0, 0), SpherePoint(-1, 0, 0), SpherePoint(0, 1, 0),
                                                    SpherePoint(0, -1, 0)};
    if (layout == SphereLayout::octahedral) return middles;
    return poles;
}

bool face_contains(const SphereCorners& p, const SpherePoint& point)
{
    // The point is a sum of the corners with factors >= 0. Signs alone mostly say that there is none.
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const auto [low, high] = std::minmax({p[0][axis], p[1][axis], p[2][axis]});
        if ((high < 0.0 && point[axis] >= 0.0) || (low > 0.0 && point[axis] <= 0.0)) return false;
    }
    int sides = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const int side = orientation(p[k], p[(k + 1) % 3], point);
        if (side == 0) return (p[0] + p[1] + p[2]).dot(point) > 0.0;
        sides += side;
    }
    return std::abs(sides) == 3 && (p[0] + p[1] + p[2]).dot(point) > 0.0;
}

PlacedFace place_face(const SphereCorners& corners, SphereLayout layout, bool turned)
{
    return layout == SphereLayout::octahedral ? octahedral(corners) : equirectangular(corners, turned);
}

}  // namespace koebe
