#include "bending/circle_path.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace koebe {
namespace {

constexpr int moments = 48;               // at which the room of a path is measured
constexpr double enough_room = 0.25;      // of the wanted room: then nothing better is searched
constexpr double apart_on_the_way = 0.6;  // of the radii at which two circles would touch, in the middle of the way
constexpr double shy = 0.3;               // of the smaller distance at the ends: room that two centres want
constexpr double equal_bow = 0.5;
constexpr double widest_bow = 1.2;
constexpr double most_pairs = 2e8;  // pairs and moments looked at in a search
constexpr int most_searches = 400;

Complex flat(Complex z) { return z / std::sqrt(std::max(1.0 - std::norm(z), 1e-12)); }
Complex round_again(Complex w) { return w / std::sqrt(1.0 + std::norm(w)); }

}  // namespace

CirclePath::CirclePath(std::vector<Circle> begin, std::vector<Circle> end, std::vector<double> bows)
    : begin_(std::move(begin)), end_(std::move(end)), bows_(std::move(bows))
{
}

bool CirclePath::straight() const
{
    return std::ranges::all_of(bows_, [](double bow) { return bow == 0.0; });
}

std::vector<Complex> CirclePath::centers_at(double share) const
{
    std::vector<Complex> centers(begin_.size(), 0.0);
    for (std::size_t k = 1; k < begin_.size(); ++k) {
        const Complex a = begin_[k].center, b = end_[k].center;
        if (bows_[k] == 0.0) {
            centers[k] = a + share * (b - a);
        } else {
            const Complex from = flat(a), to = flat(b);
            centers[k] = round_again(from + (to - from) * Complex(share, 4.0 * bows_[k] * share * (1.0 - share)));
        }
    }
    return centers;
}

std::vector<Circle> CirclePath::at(double share) const
{
    if (share <= 0.0) return begin_;
    if (share >= 1.0) return end_;
    const std::vector<Complex> centers = centers_at(share);
    std::vector<double> radii(begin_.size(), 1.0);
    for (std::size_t k = 1; k < begin_.size(); ++k)
        radii[k] = begin_[k].radius * std::pow(end_[k].radius / begin_[k].radius, share);
    const double most = 1.0 - 4.0 * share * (1.0 - share) * (1.0 - apart_on_the_way);
    std::vector<Circle> circles{Circle{}};
    for (std::size_t k = 1; k < begin_.size(); ++k) {
        double radius = std::min(radii[k], most * (1.0 - std::abs(centers[k])));
        for (std::size_t j = 1; j < begin_.size(); ++j)
            if (j != k)
                radius = std::min(radius, most * radii[k] / (radii[k] + radii[j]) * std::abs(centers[k] - centers[j]));
        circles.push_back({centers[k], radius});
    }
    return circles;
}

double CirclePath::room() const
{
    double least = 1.0;
    for (int i = 0; i <= moments; ++i) {
        const double share = static_cast<double>(i) / moments;
        const std::vector<Complex> centers = centers_at(share);
        for (std::size_t k = 1; k < begin_.size(); ++k) {
            const double radius = begin_[k].radius * std::pow(end_[k].radius / begin_[k].radius, share);
            least = std::min(least, (1.0 - std::abs(centers[k])) / radius);
            for (std::size_t j = k + 1; j < begin_.size(); ++j) {
                const double other = begin_[j].radius * std::pow(end_[j].radius / begin_[j].radius, share);
                const double wanted =
                    std::max(radius + other, shy * std::min(std::abs(begin_[k].center - begin_[j].center),
                                                            std::abs(end_[k].center - end_[j].center)));
                least = std::min(least, std::abs(centers[k] - centers[j]) / wanted);
            }
        }
    }
    return least;
}

std::vector<CirclePath> paths_between(const std::vector<Circle>& begin, const std::vector<Circle>& end)
{
    const std::size_t count = begin.size();
    std::vector<CirclePath> paths;
    std::vector<double> rooms;
    const auto add = [&](std::vector<double> bows) {
        paths.emplace_back(begin, end, std::move(bows));
        rooms.push_back(paths.back().room());
    };
    // Straight paths, and paths that all bend to one side.
    for (const double bow : {0.0, equal_bow, -equal_bow}) add(std::vector<double>(count, bow));
    // Otherwise bend single paths at random as long as the circles get more room.
    if (std::ranges::max(rooms) < enough_room && count > 2) {
        const auto best = static_cast<std::size_t>(std::ranges::max_element(rooms) - rooms.begin());
        std::vector<double> bows = paths[best].bows();
        double room = rooms[best];
        std::mt19937 random(1);
        const double size = static_cast<double>(count);
        const int searches = std::min(most_searches, static_cast<int>(most_pairs / (0.5 * size * size * moments)));
        for (int i = 0; i < searches && room < enough_room; ++i) {
            std::vector<double> changed = bows;
            changed[1 + random() % (count - 1)] =
                widest_bow * (2.0 * static_cast<double>(random()) / std::mt19937::max() - 1.0);
            const double there = CirclePath(begin, end, changed).room();
            if (there < room) continue;
            room = there;
            bows = std::move(changed);
        }
        add(std::move(bows));
    }
    // The paths without a meeting, the widest first.
    std::vector<std::size_t> order(paths.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return std::min(rooms[i], enough_room); });
    std::vector<CirclePath> sorted;
    for (const std::size_t i : order)
        if (rooms[i] > 0.0) sorted.push_back(paths[i]);
    return sorted;
}

}  // namespace koebe
