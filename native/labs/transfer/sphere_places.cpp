#include "transfer/sphere_places.h"

#include "core/errors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace koebe {
namespace {

constexpr Index straight_steps = 50;    // of a walk, before it may go on by chance
constexpr double edge_rounding = 1e-6;  // of a triangle's size: a point beside all triangles by less lies on an edge

/// The square of a cube round the sphere that a direction goes through.
std::size_t square_of(const Eigen::Vector3d& place, int squares)
{
    Eigen::Index axis = 0;
    const double most = place.cwiseAbs().maxCoeff(&axis);
    std::size_t square = 2 * static_cast<std::size_t>(axis) + (place[axis] < 0.0 ? 1 : 0);
    for (const Eigen::Index k : {1, 2}) {
        const double share = 0.5 * (place[(axis + k) % 3] / most + 1.0);
        square = square * squares + std::clamp(static_cast<int>(share * squares), 0, squares - 1);
    }
    return square;
}

}  // namespace

SpherePlaces::SpherePlaces(Vertices points, Triangles triangles)
    : points_(std::move(points)), triangles_(std::move(triangles)), across_(static_cast<std::size_t>(triangles_.size()))
{
    std::vector<std::array<Index, 3>> edges;  // both ends, and 3 f + the opposite corner
    for (Index f = 0; f < static_cast<Index>(triangles_.rows()); ++f)
        for (int k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(triangles_(f, (k + 1) % 3), triangles_(f, (k + 2) % 3));
            edges.push_back({low, high, 3 * f + k});
        }
    std::ranges::sort(edges);
    for (std::size_t e = 0; e + 1 < edges.size(); e += 2) {
        across_[edges[e][2]] = edges[e + 1][2] / 3;
        across_[edges[e + 1][2]] = edges[e][2] / 3;
    }
    squares_ = 1 + static_cast<int>(std::sqrt(static_cast<double>(triangles_.rows()) / 6.0));
    near_.assign(6 * static_cast<std::size_t>(squares_) * squares_, -1);
    for (Index f = 0; f < static_cast<Index>(triangles_.rows()); ++f)
        near_[square_of(points_(triangles_.row(f), Eigen::all).colwise().sum().transpose(), squares_)] = f;
    Index last = 0;
    for (Index& face : near_) last = face = face < 0 ? last : face;
}

/// Three times the volume of the place and each side of a triangle, with the middle of the sphere; from differences, so
/// that a small triangle keeps its digits.
Eigen::Vector3d SpherePlaces::sides(const Eigen::Vector3d& place, Index face) const
{
    std::array<Eigen::Vector3d, 3> corner;
    for (int k = 0; k < 3; ++k) corner[k] = points_.row(triangles_(face, k)).transpose() - place;
    return {place.dot(corner[1].cross(corner[2])), place.dot(corner[2].cross(corner[0])),
            place.dot(corner[0].cross(corner[1]))};
}

SurfacePoint SpherePlaces::at(const Eigen::Vector3d& place, Index start) const
{
    Index face = start >= 0 ? start : near_[square_of(place, squares_)];
    Eigen::Vector3d side = sides(place, face);
    std::uint32_t random = 1;
    const auto most = 16 * static_cast<Index>(std::sqrt(static_cast<double>(triangles_.rows()))) + 200;
    for (Index step = 0; step < most && side.minCoeff() < 0.0; ++step) {
        Eigen::Index k = 0;
        side.minCoeff(&k);
        // A long walk may go in a circle: it takes another side by chance.
        random = random * 1664525U + 1013904223U;
        if (const Eigen::Index other = (random >> 16) % 3; step > straight_steps && side[other] < 0.0) k = other;
        face = across_[3 * face + k];
        side = sides(place, face);
    }
    // The walk has not arrived: rounding on an edge, or too many steps. Then all triangles are tried.
    if (side.minCoeff() < 0.0) {
        double best = -std::numeric_limits<double>::infinity();
        for (Index f = 0; f < static_cast<Index>(triangles_.rows()); ++f) {
            if (points_(triangles_.row(f), Eigen::all).colwise().sum().dot(place) <= 0.0) continue;
            const Eigen::Vector3d of = sides(place, f);
            const double worth = of.minCoeff() / std::max(of.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
            if (worth > best) {
                best = worth;
                face = f;
                side = of;
            }
        }
        if (!(best >= -edge_rounding)) throw SolverError("a point of the sphere lies in no triangle");
    }
    const Eigen::Vector3d weights = side.cwiseMax(0.0);
    return {face, (weights / weights.sum()).transpose()};
}

}  // namespace koebe
