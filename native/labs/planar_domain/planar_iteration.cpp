#include "planar_domain/planar_iteration.h"

#include "circles/circle_fit.h"
#include "core/errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace koebe {
namespace {

constexpr int first_powers = 12;               // beside the poles
constexpr double round_enough = 2e-14;         // deviation from circles, of the radius, before a rim's turn
constexpr double digits = 36.0;                // log of what powers have to fall by
constexpr double least_share = 1e-4;           // of a corner's cut: nearer to it, mirror images are not needed
constexpr double pole_spacing = 0.18;          // of mirrored poles, of their distance from the circle
constexpr double mirror_share = 0.9;           // of another rim's radius, for poles in its mirror image
constexpr double densest = 0.1, growth = 1.2;  // of samples in a gap: the first one's place, ratio of their places
constexpr double least_gap = 1e-9;             // of the radius
constexpr double share_of_residual = 1e-3;     // of the first maps: what the iteration may leave beside it

/// Twice as many points as a layout's samples, between them and nearer to corners, to judge a map by.
RimLayout check_layout(const PlanarRim& rim, const RimPolygon& polygon, bool is_outer, RimResolution resolution)
{
    resolution.corner_poles = 2 * resolution.corner_poles + 3;
    resolution.panel_poles = 2 * resolution.panel_poles + 1;
    return rim_layout(rim, polygon, is_outer, resolution);
}

Circle fitted(const RimLayout& layout)
{
    VectorXcd points(static_cast<Eigen::Index>(layout.samples.size()));
    for (Eigen::Index i = 0; i < points.size(); ++i) points[i] = layout.samples[static_cast<std::size_t>(i)].place;
    return fit_circle_least_squares(points);
}

double deviation(const RimLayout& layout, const Circle& circle)
{
    double most = 0.0;
    for (const RimSample& sample : layout.samples) {
        const double off = std::abs(std::abs(sample.place - circle.center) - circle.radius);
        most = std::isfinite(off) ? std::max(most, off) : std::numeric_limits<double>::infinity();
    }
    return most;
}

/// Leaves out poles that are not on their side of the rim: mapped ones may have crossed it.
void keep_poles_off_domain(RimLayout& layout)
{
    RimPolygon ring;
    for (const RimSample& sample : layout.samples) ring.points.push_back(sample.place);
    std::erase_if(layout.poles, [&](Complex pole) { return (ring.winding(pole) != 0) == layout.is_outer; });
    std::erase_if(layout.corners, [](const RimCorner& corner) { return corner.poles.empty(); });
    for (RimCorner& corner : layout.corners)
        for (int halvings = 0; halvings < 8; ++halvings) {
            const auto is_off = [&](double x) {
                return (ring.winding(corner.vertex + x * (corner.cut_end - corner.vertex)) != 0) != layout.is_outer;
            };
            if (is_off(1.0) && is_off(0.75) && is_off(0.5) && is_off(0.25)) break;
            corner.cut_end = corner.vertex + 0.5 * (corner.cut_end - corner.vertex);
        }
}

/// The distance of a rim from a circle, and its nearest sample.
std::pair<double, Complex> gap_from(const Circle& circle, const RimLayout& rim)
{
    std::pair<double, Complex> least{std::numeric_limits<double>::infinity(), 0.0};
    for (const RimSample& sample : rim.samples)
        if (const double d = std::abs(std::abs(sample.place - circle.center) - circle.radius); d < least.first)
            least = {d, sample.place};
    return least;
}

/// Samples on a circle where another rim is near, as dense as the gap is narrow.
void add_samples_near(RimLayout& layout, const Circle& circle, const RimLayout& other)
{
    const auto [gap, place] = gap_from(circle, other);
    const double spacing = 2.0 * std::numbers::pi / static_cast<double>(layout.samples.size());
    const double angle = std::arg(place - circle.center);
    for (double off = std::max(gap / circle.radius, least_gap) * densest;
         off < 4.0 * spacing / (growth - 1.0) && off < 3.0; off *= growth)
        for (const double side : {-1.0, 1.0})
            layout.samples.push_back({circle.center + std::polar(circle.radius, angle + side * off)});
}

Complex mirrored(const Circle& circle, Complex place)
{
    return circle.center + circle.radius * circle.radius / std::conj(place - circle.center);
}

/// Poles where the map of a rim, nearly a circle, may be singular: on the mirror image of another rim's circle.
void add_mirror_poles(RimLayout& layout, const Circle& circle, const Circle& other, int count)
{
    const bool encloses = std::abs(other.center - circle.center) < other.radius;
    const double radius = other.radius * (encloses ? 1.0 / mirror_share : mirror_share);
    for (int i = 0; i < count; ++i) {
        const Complex place = other.center + std::polar(radius, 2.0 * std::numbers::pi * (i + 0.5) / count);
        layout.poles.push_back(mirrored(circle, place));
    }
}

/// Mirror images of the places where another rim's map will have its poles: that map bends this circle, and the map
/// that makes it round again is singular there.
/// @param reach poles farther from the circle are left out
void add_mirrored(std::vector<Complex>& poles, const Circle& circle, const RimLayout& other, double reach)
{
    const auto add = [&](Complex place) {
        const Complex image = mirrored(circle, place);
        const double gap = std::abs(std::abs(image - circle.center) - circle.radius);
        const auto is_close = [&](Complex pole) { return std::abs(pole - image) < pole_spacing * gap; };
        if (gap < reach && std::ranges::none_of(poles, is_close)) poles.push_back(image);
    };
    for (const Complex pole : other.poles) add(pole);
    for (const RimCorner& corner : other.corners)
        for (const double pole : corner.poles) {
            const double share = pole * pole / (1.0 + pole * pole);  // of the cut
            if (share > least_share) add(corner.vertex + share * (corner.cut_end - corner.vertex));
        }
}

}  // namespace

KoebeIteration::KoebeIteration(const OrderedRims& domain, const RimResolution& resolution) : resolution_(resolution)
{
    for (std::size_t k = 0; k < domain.rims.size(); ++k) {
        const std::vector<Index> rim{domain.order[k]};
        try {
            layouts_.push_back(rim_layout(domain.rims[k], domain.polygons[k], k == 0, resolution));
            checks_.push_back(check_layout(domain.rims[k], domain.polygons[k], k == 0, resolution));
        } catch (const InputError& error) {
            throw InputError(error.what(), ElementKind::loops, rim);
        }
    }
}

std::size_t KoebeIteration::most_work() const
{
    std::size_t most = 0;
    for (const RimLayout& layout : layouts_) {
        std::size_t functions = layout.poles.size();
        for (const RimCorner& corner : layout.corners) functions += corner.poles.size();
        most = std::max(most, layout.samples.size() * 2 * functions);
    }
    return most;
}

bool KoebeIteration::run(int max_sweeps, const std::vector<double>& enough, ExecutionContext& context)
{
    double last = std::numeric_limits<double>::infinity();
    for (sweeps = 0; sweeps < max_sweeps; ++sweeps) {
        double most = 0.0;
        for (std::size_t k = 0; k < layouts_.size(); ++k) {
            context.advance(static_cast<double>(sweeps * layouts_.size() + k) /
                            static_cast<double>((sweeps + 3) * layouts_.size()));
            most = std::max(most, turn(k));
            if (sweeps == 0 && !(first_residuals.back() < enough[k])) return false;
        }
        const double still = std::max(round_enough, share_of_residual * *std::ranges::max_element(first_residuals));
        if (sweeps > 0 && (most < still || (most < 1e-9 && most > 0.5 * last) || layouts_.size() == 1)) break;
        if (!std::isfinite(most)) break;
        last = most;
    }
    return true;
}

std::vector<double> KoebeIteration::residuals() const
{
    std::vector<double> all;
    const double size = fitted(layouts_[0]).radius;
    for (std::size_t k = 0; k < layouts_.size(); ++k) {
        const Circle circle = fitted(layouts_[k]);
        all.push_back(std::max(deviation(layouts_[k], circle), deviation(checks_[k], circle)) / size);
    }
    return all;
}

std::vector<Circle> KoebeIteration::circles() const
{
    const Circle outer = fitted(layouts_[0]);
    std::vector<Circle> all{Circle{}};
    for (std::size_t k = 1; k < layouts_.size(); ++k) {
        const Circle circle = fitted(layouts_[k]);
        all.push_back({(circle.center - outer.center) / outer.radius, circle.radius / outer.radius});
    }
    return all;
}

Circle KoebeIteration::outer() const { return fitted(layouts_[0]); }

double KoebeIteration::turn(std::size_t k)
{
    RimLayout& own = layouts_[k];
    const bool first = maps.size() < layouts_.size();
    double off = 1.0;
    if (first) {
        keep_poles_off_domain(own);
    } else {  // poles are the mirror images of near rims in the circle that fits
        const Circle circle = fitted(own);
        off = deviation(own, circle) / circle.radius;
        own.center = circle.center;
        for (std::size_t j = 0; j < layouts_.size(); ++j)
            if (j != k && (sweeps > 1 || j < k) && is_near(circle, layouts_[j]))
                add_mirror_poles(own, circle, fitted(layouts_[j]), 2 * resolution_.panel_poles);
    }
    // The outside of the rim goes to that of a circle, and takes the other rims with it.
    const RimMap map(own, first ? first_powers : powers(), !first);
    if (first) first_residuals.push_back(map.residual());
    unknowns = std::max(unknowns, 2 * map.unknowns() - 1);
    for (RimSample& sample : checks_[k].samples) sample = {map.on_own_rim(sample)};
    for (std::size_t j = 0; j < layouts_.size(); ++j)
        if (j != k) {
            checks_[j].samples = map(checks_[j].samples, layouts_[j].corners);
            layouts_[j] = map(layouts_[j]);
        }
    // The rim is that circle now, with poles and samples for its next turn.
    const Circle circle{map.is_outer() ? Complex(0.0) : map.center(), map.radius()};
    std::vector<Complex> poles;
    for (std::size_t j = k + 1; first && j < layouts_.size(); ++j)
        add_mirrored(poles, circle, layouts_[j], reach(circle));
    const int points = std::max(resolution_.circle_points, 3 * (static_cast<int>(poles.size()) + powers()));
    own = circle_layout(circle, map.is_outer(), points);
    own.poles = std::move(poles);
    for (std::size_t j = 0; j < layouts_.size(); ++j)
        if (j != k) add_samples_near(own, circle, layouts_[j]);
    maps.push_back(map);
    return off;
}

double KoebeIteration::reach(const Circle& circle) const { return digits * circle.radius / powers(); }

bool KoebeIteration::is_near(const Circle& circle, const RimLayout& other) const
{
    return gap_from(circle, other).first < reach(circle);
}

}  // namespace koebe
