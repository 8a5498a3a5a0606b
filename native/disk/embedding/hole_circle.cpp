#include "embedding/hole_circle.h"

#include "circles/circle_fit.h"
#include "circles/crowded_circles.h"
#include "planar/planar_predicates.h"
#include "planar/star_centre.h"

#include <algorithm>
#include <cmath>

namespace koebe {
namespace {

constexpr double share_of_room = 0.9;

/// The largest radius of a circle round a point that stays in the hole; negative outside.
double free_radius(const VectorXcd& image, Complex centre)
{
    double least = 1.0;
    for (Eigen::Index i = 0; i < image.size(); ++i) {
        const Complex a = image[i], b = image[(i + 1) % image.size()];
        const double length = std::abs(b - a);
        if (length > 0.0) least = std::min(least, cross(centre - a, b - a) / length);
    }
    return least;
}

}  // namespace

bool fit_hole_circles(const std::vector<VectorXcd>& images, const std::vector<Complex>& fan_centres,
                      const std::vector<char>& refit, HoleCircle kind, std::vector<Circle>& circles)
{
    std::vector<double> inside(circles.size(), 0.0);
    for (std::size_t k = 1; k < circles.size(); ++k) {
        if (!refit[k]) continue;
        circles[k] = fit_circle_least_squares(images[k]);
        inside[k] = free_radius(images[k], circles[k].center);
        if (kind == HoleCircle::through && inside[k] > 0.0) continue;
        std::vector<Complex> hole(images[k].begin(), images[k].end());
        std::ranges::reverse(hole);
        const Complex middle =
            star_centre(hole, std::vector<double>(hole.size(), 1.0), fan_centres[k]).value_or(fan_centres[k]);
        inside[k] = free_radius(images[k], middle);
        circles[k] = {middle, kind == HoleCircle::inside ? share_of_room * inside[k]
                                                         : (images[k].array() - middle).abs().mean()};
    }
    const std::vector<Circle> before = circles;
    for (std::size_t k = 1; k < circles.size(); ++k) {
        if (!refit[k]) continue;
        double room = 1.0 - std::abs(before[k].center);
        for (std::size_t j = 1; j < circles.size(); ++j) {
            if (j == k) continue;
            const double distance = std::abs(before[k].center - before[j].center);
            room = std::min(room, refit[j] ? distance * before[k].radius / (before[k].radius + before[j].radius)
                                           : distance - before[j].radius);
        }
        if (before[k].radius > share_of_room * room)
            circles[k].radius = std::max(std::min(inside[k], share_of_room * room), 1e-12);
    }
    return circles_apart(circles);
}

}  // namespace koebe
