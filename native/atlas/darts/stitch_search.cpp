#include "darts/stitch_search.h"

#include "core/complex_places.h"
#include "core/connectivity.h"
#include "darts/tension.h"
#include "flat/part_borders.h"
#include "flat/part_look.h"
#include "planar/rigid_fit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace koebe {
namespace {

constexpr std::size_t most_places = 32;  // along a border, at which a stretch may begin or end

/// A stretch, between two places of a border.
struct BorderWindow {
    std::size_t from = 0, to = 0;
};

/// Sums along a border up to each of its places, so that those of a stretch are differences.
struct BorderSums {
    std::vector<RigidFit> fit;  ///< of both sides in the plane; one more than there are places
    std::vector<double> cost{0.0}, length{0.0};
    std::vector<int> refused{0};  ///< edges in the middle of stretches that did not pay

    RigidFit fit_of(BorderWindow window) const { return fit[window.to + 1] - fit[window.from]; }
    double cost_of(BorderWindow window) const { return cost[window.to] - cost[window.from]; }
    double length_of(BorderWindow window) const { return length[window.to] - length[window.from]; }
    bool refuses(BorderWindow window) const { return refused[window.to] > refused[window.from]; }
};

class StitchSearch {
public:
    StitchSearch(const std::vector<FlatPart>& parts, const ThroughPrice& price, const std::set<EdgeEnds>& refused)
        : parts_(parts), price_(price), refused_(refused), borders_(parts)
    {
        for (const FlatPart& part : parts) {
            looks_.push_back(look_of(part));
            area_ += looks_.back().area;
        }
    }

    std::optional<Stitch> best() const
    {
        std::optional<Stitch> best;
        for (const PartBorder& border : borders_.all())
            if (auto stitch = best_along(border); stitch && (!best || stitch->forecast > best->forecast))
                best = std::move(stitch);
        return best;
    }

private:
    double seen_length(const FlatPart& part, Index h) const
    {
        const Index a = origin(part.surface.triangles, h), b = target(part.surface.triangles, h);
        return price_of_edge(part.shown, a, b) * length_on_part(part, h);
    }

    /// A closed border begins where it is least seen.
    PartBorder opened(PartBorder border) const
    {
        if (!border.is_ring) return border;
        const FlatPart& part = parts_[border.first];
        const auto least = std::ranges::min_element(
            border.of_first, {}, [&](Index h) { return seen_length(part, h) / length_on_part(part, h); });
        const auto at = least - border.of_first.begin();
        std::rotate(border.of_first.begin(), border.of_first.begin() + at, border.of_first.end());
        std::rotate(border.of_second.begin(), border.of_second.begin() + at, border.of_second.end());
        return border;
    }

    BorderSums sums_along(const PartBorder& border) const
    {
        const FlatPart &first = parts_[border.first], &second = parts_[border.second];
        BorderSums sums;
        for (const Index h : border.of_first) {
            sums.cost.push_back(sums.cost.back() + seen_length(first, h));
            sums.length.push_back(sums.length.back() + length_on_part(first, h));
            sums.refused.push_back(sums.refused.back() + (refused_.contains(borders_.name({border.first, h})) ? 1 : 0));
        }
        sums.fit.emplace_back();
        for (std::size_t i = 0; i <= border.edges(); ++i) {
            const auto [v, w] = borders_.vertices_at(border, i);
            const double beside = sums.length[std::min(i + 1, border.edges())] - sums.length[i > 0 ? i - 1 : 0];
            sums.fit.push_back(sums.fit.back());
            sums.fit.back().add(complex_at(first.points, v), complex_at(second.points, w), beside);
        }
        return sums;
    }

    /// For each place of a border its mirror image on the same border; empty if it has none.
    std::vector<std::size_t> mirrored_places(const PartBorder& border) const
    {
        const FlatPart& first = parts_[border.first];
        std::vector<std::size_t> mirror;
        if (first.image.empty()) return mirror;
        std::vector<Index> names, images;
        for (std::size_t i = 0; i <= border.edges(); ++i) {
            const Index v = borders_.vertices_at(border, i).first;
            names.push_back(first.original[v]);
            images.push_back(first.image[v]);
        }
        std::map<Index, std::size_t> place;
        for (std::size_t i = 0; i < names.size(); ++i) place.emplace(names[i], i);
        for (const Index image : images) {
            const auto found = place.find(image);
            if (found == place.end()) return {};
            mirror.push_back(found->second);
        }
        return mirror;
    }

    /// The stretch with its mirror image, if both meet.
    static std::optional<BorderWindow> symmetric(BorderWindow window, const std::vector<std::size_t>& mirror)
    {
        if (mirror.empty()) return window;
        const auto [low, high] = std::minmax(mirror[window.from], mirror[window.to]);
        if (low > window.to || high < window.from) return {};
        return BorderWindow{std::min(window.from, low), std::max(window.to, high)};
    }

    /// What a stretch saves, its cut and one island where the neck is as wide as the smaller part; and what it wins:
    /// that, less what bends and what compactness is lost.
    Stitch worth_of(const PartBorder& border, const BorderSums& sums, BorderWindow window) const
    {
        const double cost = sums.cost_of(window), length = sums.length_of(window);
        const RigidFit fit = sums.fit_of(window);
        if (border.is_slit()) {
            const double saved = stitch_saving({price_.length, {}}, cost, 0.0);
            return {{}, saved, saved - tuning::bent_border * fit.distance()};
        }
        const PartLook &a = looks_[border.first], &b = looks_[border.second];
        const double saved = stitch_saving(price_, cost, length / std::sqrt(std::min(a.area, b.area)));
        const PartLook both{a.area + b.area, a.length + b.length - 2.0 * length};
        const double loss = roundness_loss((a.compact_area() + b.compact_area()) / area_, both.compact_area() / area_);
        return {{}, saved, saved - loss - tuning::bent_border * fit.misfit()};
    }

    std::optional<Stitch> best_along(const PartBorder& closed) const
    {
        if (is_true_to_size(parts_[closed.first]) || is_true_to_size(parts_[closed.second])) return {};
        const PartBorder border = opened(closed);
        const BorderSums sums = sums_along(border);
        const std::vector<std::size_t> mirror = mirrored_places(border);
        const std::size_t count = border.edges(), step = std::max<std::size_t>(1, count / most_places);
        BorderWindow best;
        Stitch most;
        for (std::size_t i = 0; i < count; i += step)
            for (std::size_t j = i; j < count;) {
                j = std::min(count, j + step);
                const auto window = symmetric({i, j}, mirror);
                if (!window || sums.refuses(*window)) continue;
                if (border.is_ring && window->to - window->from == count) continue;
                if (Stitch found = worth_of(border, sums, *window); found.forecast > most.forecast) {
                    most = std::move(found);
                    best = *window;
                }
            }
        if (!(most.forecast > 0.0)) return {};
        return with_image(border, best, std::move(most));
    }

    /// The stitch along a stretch, and along its mirror image where that is another one.
    std::optional<Stitch> with_image(const PartBorder& border, BorderWindow window, Stitch stitch) const
    {
        BorderStretch own, image;
        for (std::size_t i = window.from; i < window.to; ++i) {
            const PartEdge edge{border.first, border.of_first[i]};
            own.push_back(borders_.name(edge));
            if (!parts_[border.first].image.empty()) image.push_back(borders_.image(edge));
        }
        const std::set<EdgeEnds> names(own.begin(), own.end());
        const auto common = std::ranges::count_if(image, [&](const EdgeEnds& edge) { return names.contains(edge); });
        if (common > 0 && common < std::ssize(image)) return {};
        stitch.stretches.push_back(std::move(own));
        if (image.empty() || common > 0) return stitch;
        if (!std::ranges::all_of(image, [&](const EdgeEnds& edge) { return borders_.find(edge); })) return {};
        stitch.stretches.push_back(std::move(image));
        stitch.saved *= 2.0;
        stitch.forecast *= 2.0;
        return stitch;
    }

    const std::vector<FlatPart>& parts_;
    ThroughPrice price_;
    const std::set<EdgeEnds>& refused_;
    PartBorders borders_;
    std::vector<PartLook> looks_;
    double area_ = 0.0;
};

}  // namespace

std::optional<Stitch> best_stitch(const std::vector<FlatPart>& parts, const ThroughPrice& price,
                                  const std::set<EdgeEnds>& refused)
{
    return StitchSearch(parts, price, refused).best();
}

double length_on_part(const FlatPart& part, Index h)
{
    const Triangles& triangles = part.surface.triangles;
    return (part.vertices.row(origin(triangles, h)) - part.vertices.row(target(triangles, h))).norm();
}

}  // namespace koebe
