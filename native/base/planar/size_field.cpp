#include "planar/size_field.h"

#include "planar/planar_predicates.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace koebe {
namespace {

constexpr std::size_t run_length = 8;

}  // namespace

SizeField::SizeField(const std::vector<VectorXcd>& polygons, double longest, double gradation)
    : longest_(longest), gradation_(gradation), levels_(1)
{
    for (const VectorXcd& polygon : polygons)
        for (Eigen::Index i = 0, n = polygon.size(); i < n; ++i) {
            const Complex here = polygon[i];
            const double length =
                0.5 * (distance(polygon[(i + 1) % n], here) + distance(here, polygon[(i + n - 1) % n]));
            levels_[0].push_back({0, 0, here, 0.0, length});
        }
    while (levels_.back().size() > run_length) {
        const std::vector<Run>& below = levels_.back();
        std::vector<Run> runs;
        for (std::size_t begin = 0; begin < below.size(); begin += run_length) {
            Run run = below[begin];
            run.begin = begin;
            run.end = std::min(begin + run_length, below.size());
            for (std::size_t i = begin; i < run.end; ++i) {
                run.radius = std::max(run.radius, distance(run.center, below[i].center) + below[i].radius);
                run.shortest = std::min(run.shortest, below[i].shortest);
            }
            runs.push_back(run);
        }
        levels_.push_back(std::move(runs));
    }
}

/// A bound for the sizes wanted by a run's vertices: the size itself for one vertex.
double SizeField::least_in(const Run& run, Complex place) const
{
    return run.shortest + gradation_ * std::max(distance(place, run.center) - run.radius, 0.0);
}

/// Lowers `size` to the least size wanted by these runs of a level. The runs with the lowest bounds come first.
void SizeField::look(std::size_t level, std::size_t begin, std::size_t end, Complex place, double& size) const
{
    std::array<std::pair<double, std::size_t>, run_length> bounds;
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i) {
        const double bound = least_in(levels_[level][i], place);
        if (!(bound < size)) continue;
        if (level == 0)
            size = bound;
        else
            bounds[count++] = {bound, i};
    }
    std::sort(bounds.begin(), bounds.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t i = 0; i < count && bounds[i].first < size; ++i) {
        const Run& run = levels_[level][bounds[i].second];
        look(level - 1, run.begin, run.end, place, size);
    }
}

double SizeField::operator()(Complex place) const
{
    // The field is Lipschitz: it bounds its values near the last one.
    constexpr double rounding = 1e-9;
    double size = std::min(longest_, (1.0 + rounding) * (last_size_ + gradation_ * distance(place, last_place_)));
    look(levels_.size() - 1, 0, levels_.back().size(), place, size);
    last_place_ = place;
    return last_size_ = size;
}

}  // namespace koebe
