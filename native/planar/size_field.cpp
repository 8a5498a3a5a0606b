#include "planar/size_field.h"

#include "planar/planar_predicates.h"

#include <algorithm>
#include <cmath>

namespace koebe {
namespace {

constexpr Eigen::Index run_length = 16;

}  // namespace

SizeField::SizeField(const std::vector<VectorXcd>& polygons, double longest, double gradation)
    : longest_(longest), gradation_(gradation)
{
    for (const VectorXcd& polygon : polygons)
        for (Eigen::Index i = 0, n = polygon.size(); i < n; ++i) {
            const Complex here = polygon[i];
            const double length =
                0.5 * (distance(polygon[(i + 1) % n], here) + distance(here, polygon[(i + n - 1) % n]));
            if (i % run_length == 0) runs_.push_back({sites_.size(), sites_.size(), here, 0.0, length});
            sites_.push_back({here, length});
            Run& run = runs_.back();
            run.end = sites_.size();
            run.radius = std::max(run.radius, distance(run.center, here));
            run.shortest = std::min(run.shortest, length);
        }
}

double SizeField::operator()(Complex place) const
{
    double size = longest_;
    for (const Run& run : runs_) {
        if (run.shortest + gradation_ * (distance(place, run.center) - run.radius) >= size) continue;
        for (std::size_t i = run.begin; i < run.end; ++i)
            size = std::min(size, sites_[i].length + gradation_ * distance(place, sites_[i].place));
    }
    return size;
}

}  // namespace koebe
