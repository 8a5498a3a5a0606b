#include "planar_domain/planar_map.h"

#include "circles/circle_fit.h"
#include "circles/crowded_circles.h"
#include "core/counted.h"
#include "core/errors.h"
#include "planar_domain/rim_layout.h"
#include "shape/conformal_module.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

namespace koebe {
namespace {

constexpr std::array resolutions{RimResolution{14, 6, 128}, RimResolution{20, 9, 192}, RimResolution{28, 12, 256},
                                 RimResolution{38, 16, 384}, RimResolution{50, 20, 512}};
constexpr int first_powers = 12;                // beside the poles
constexpr std::size_t most_entries = 40000000;  // of a system: 320 MB
constexpr double round_enough = 2e-14;          // deviation from circles, of the radius, before a rim's turn
constexpr double digits = 36.0;                 // log of what powers have to fall by
constexpr double least_share = 1e-4;            // of a corner's cut: nearer to it, mirror images are not needed
constexpr double pole_spacing = 0.18;           // of mirrored poles, of their distance from the circle
constexpr double mirror_share = 0.9;            // of another rim's radius, for poles in its mirror image
constexpr double densest = 0.1, growth = 1.2;   // of samples in a gap: the first one's place, ratio of their places
constexpr double least_gap = 1e-9;              // of the radius
constexpr double share_of_residual = 1e-3;      // of the first maps: what the iteration may leave beside it
constexpr double useless = 1e-3;                // residual: no circles
constexpr double off_domain = 1e-8;             // disk units: images so far off the circle domain are refused

/// Points between a layout's samples, to judge a map by.
RimLayout check_layout(const PlanarRim& rim, const RimPolygon& polygon, bool is_outer, RimResolution resolution)
{
    resolution.corner_poles += 3;
    resolution.panel_poles += 1;
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

/// Koebe's iteration at one resolution.
class KoebeIteration {
public:
    KoebeIteration(const OrderedRims& domain, const RimResolution& resolution) : resolution_(resolution)
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

    /// The entries of the largest system.
    std::size_t most_work() const
    {
        std::size_t most = 0;
        for (const RimLayout& layout : layouts_) {
            std::size_t functions = layout.poles.size();
            for (const RimCorner& corner : layout.corners) functions += corner.poles.size();
            most = std::max(most, layout.samples.size() * 2 * functions);
        }
        return most;
    }

    void run(int max_sweeps, ExecutionContext& context)
    {
        double last = std::numeric_limits<double>::infinity();
        for (sweeps = 0; sweeps < max_sweeps; ++sweeps) {
            double most = 0.0;
            for (std::size_t k = 0; k < layouts_.size(); ++k) {
                context.advance(static_cast<double>(sweeps * layouts_.size() + k) /
                                static_cast<double>((sweeps + 3) * layouts_.size()));
                most = std::max(most, turn(k));
            }
            const double enough = std::max(round_enough, share_of_residual * first_residual_);
            if (sweeps > 0 && (most < enough || (most < 1e-9 && most > 0.5 * last) || layouts_.size() == 1)) break;
            if (!std::isfinite(most)) break;
            last = most;
        }
    }

    /// Distances of the rims' images from circles, the outer one of radius 1.
    std::vector<double> residuals() const
    {
        std::vector<double> all;
        const double size = fitted(layouts_[0]).radius;
        for (std::size_t k = 0; k < layouts_.size(); ++k) {
            const Circle circle = fitted(layouts_[k]);
            all.push_back(std::max(deviation(layouts_[k], circle), deviation(checks_[k], circle)) / size);
        }
        return all;
    }

    std::vector<Circle> circles() const
    {
        const Circle outer = fitted(layouts_[0]);
        std::vector<Circle> all{Circle{}};
        for (std::size_t k = 1; k < layouts_.size(); ++k) {
            const Circle circle = fitted(layouts_[k]);
            all.push_back({(circle.center - outer.center) / outer.radius, circle.radius / outer.radius});
        }
        return all;
    }

    Circle outer() const { return fitted(layouts_[0]); }

    std::vector<RimMap> maps;
    int sweeps = 0;
    Eigen::Index unknowns = 0;

private:
    /// One rim becomes a circle. @return how far it was from one, in its radius
    double turn(std::size_t k)
    {
        RimLayout& own = layouts_[k];
        const bool first = maps.size() < layouts_.size();
        double off = 1.0;
        if (first) {
            keep_poles_off_domain(own);
        } else {
            const Circle circle = fitted(own);
            off = deviation(own, circle) / circle.radius;
            own.center = circle.center;
            for (std::size_t j = 0; j < layouts_.size(); ++j)
                if (j != k && (sweeps > 1 || j < k) && is_near(circle, layouts_[j]))
                    add_mirror_poles(own, circle, fitted(layouts_[j]), 2 * resolution_.panel_poles);
        }
        const RimMap map(own, first ? first_powers : powers(), !first);
        if (first) first_residual_ = std::max(first_residual_, map.residual());
        unknowns = std::max(unknowns, 2 * map.unknowns() - 1);
        for (RimSample& sample : checks_[k].samples) sample = {map.on_own_rim(sample)};
        for (std::size_t j = 0; j < layouts_.size(); ++j)
            if (j != k) {
                for (RimSample& sample : checks_[j].samples) sample = map(sample, layouts_[j].corners);
                layouts_[j] = map(layouts_[j]);
            }
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

    int powers() const { return resolution_.circle_points / 4; }
    /// A singularity of a map that is farther than this from its circle is resolved by powers.
    double reach(const Circle& circle) const { return digits * circle.radius / powers(); }
    bool is_near(const Circle& circle, const RimLayout& other) const
    {
        return gap_from(circle, other).first < reach(circle);
    }

    RimResolution resolution_;
    double first_residual_ = 0.0;  // of the maps of the rims as given
    std::vector<RimLayout> layouts_, checks_;
};

/// The rims moved and scaled to about the unit disk.
OrderedRims scaled(OrderedRims domain, Complex middle, double size)
{
    for (std::size_t k = 0; k < domain.rims.size(); ++k) {
        PlanarRim& rim = domain.rims[k];
        for (Complex& z : rim.curve) z = (z - middle) / size;
        for (std::size_t j = 0; j < rim.fourier.size(); ++j) {
            if (rim.lowest + static_cast<int>(j) == 0) rim.fourier[j] -= middle;
            rim.fourier[j] /= size;
        }
        const Complex center = (domain.polygons[k].center - middle) / size;
        domain.polygons[k] = rim_polygon(rim);
        domain.polygons[k].center = center;
    }
    return domain;
}

double change(const std::vector<Circle>& a, const std::vector<Circle>& b)
{
    double most = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k)
        most = std::max({most, std::abs(a[k].center - b[k].center), std::abs(a[k].radius - b[k].radius)});
    return most;
}

/// The middle of a rim's box, and half of its diagonal.
std::pair<Complex, double> box_of(const RimPolygon& rim)
{
    Complex low = rim.points[0], high = low;
    for (const Complex z : rim.points) {
        low = {std::min(low.real(), z.real()), std::min(low.imag(), z.imag())};
        high = {std::max(high.real(), z.real()), std::max(high.imag(), z.imag())};
    }
    return {0.5 * (low + high), 0.5 * std::abs(high - low)};
}

/// @param coarser the circles of the next coarser resolution, or empty
void estimate_errors(PlanarResult& result, const std::vector<Circle>& coarser)
{
    result.error = *std::ranges::max_element(result.residuals);
    result.module_errors = VectorXd::Constant(result.module.size(), result.error);
    if (coarser.empty()) return;
    result.error = std::max(result.error, change(result.circles, coarser));
    result.module_errors = result.module_errors.cwiseMax((result.module - conformal_module(coarser)).cwiseAbs());
}

/// Whether a place lies in the circle domain, up to rounding. @param circles the unit circle, then the holes
bool lies_inside(Complex z, const std::vector<Circle>& circles)
{
    return std::abs(z) <= 1.0 + off_domain && std::all_of(circles.begin() + 1, circles.end(), [&](const Circle& hole) {
               return std::abs(z - hole.center) >= hole.radius - off_domain;
           });
}

[[noreturn]] void refuse(const std::vector<double>& residuals, const std::vector<int>& order)
{
    std::vector<Index> worst;
    const double most = *std::ranges::max_element(residuals);
    for (std::size_t k = 0; k < residuals.size(); ++k)
        if (!(residuals[k] < 0.1 * most)) worst.push_back(order[k]);
    std::ranges::sort(worst);
    throw SolverError("the rims' images are no circles: rims are too near each other, or narrows of the domain are too "
                      "long, to be resolved (rims listed)",
                      ElementKind::loops, worst);
}

}  // namespace

PlanarMap::PlanarMap(Complex middle, double size, std::vector<RimPolygon> rims, std::vector<RimMap> maps, Circle outer)
    : middle_(middle), size_(size), rims_(std::move(rims)), maps_(std::move(maps)), outer_(outer)
{
}

void PlanarMap::normalize(const Moebius& last, std::vector<Circle> circles)
{
    last_ = last;
    circles_ = std::move(circles);
}

Complex PlanarMap::image(Complex place) const
{
    Complex z = (place - middle_) / size_;
    for (const RimMap& map : maps_) z = map(z);
    return last_((z - outer_.center) / outer_.radius);
}

Complex PlanarMap::preimage(Complex image) const
{
    Complex z = outer_.center + outer_.radius * last_.inverse()(image);
    for (std::size_t k = maps_.size(); k-- > 0;) z = maps_[k].inverse(z);
    z = middle_ + size_ * z;
    // Errors of the steps add up: Newton's method on the whole.
    for (int i = 0; i < 3; ++i) {
        const Complex better = z - (this->image(z) - image) / derivative(z);
        if (!(std::abs(this->image(better) - image) < std::abs(this->image(z) - image))) break;
        z = better;
    }
    return z;
}

Complex PlanarMap::derivative(Complex place) const
{
    Complex z = (place - middle_) / size_, slope = 1.0 / size_;
    for (const RimMap& map : maps_) {
        slope *= map.derivative(z);
        z = map(z);
    }
    z = (z - outer_.center) / outer_.radius;
    const Complex pole = 1.0 - std::conj(last_.a) * z;
    return slope / outer_.radius * last_.turn * (1.0 - std::norm(last_.a)) / (pole * pole);
}

VectorXcd PlanarMap::operator()(const VectorXcd& places) const
{
    VectorXcd images(places.size());
    std::vector<Index> off;
    for (Eigen::Index i = 0; i < places.size(); ++i) {
        images[i] = image(places[i]);
        bool inside = lies_inside(images[i], circles_);
        // The formulas go on beyond the rims: a place that is clearly off the domain is refused by the rims themselves.
        for (std::size_t k = 0; k < rims_.size() && inside; ++k) {
            const bool wrong = (rims_[k].winding(places[i]) != 0) != (k == 0);
            inside = !wrong || rims_[k].distance(places[i]) <= rims_[k].chord_error + 1e-12 * size_;
        }
        if (!inside) off.push_back(static_cast<Index>(i));
    }
    if (!off.empty()) throw InputError("points lie off the domain (listed)", ElementKind::points, off);
    return images;
}

VectorXcd PlanarMap::inverse(const VectorXcd& images) const
{
    VectorXcd places(images.size());
    std::vector<Index> off, lost;
    for (Eigen::Index i = 0; i < images.size(); ++i) {
        if (!lies_inside(images[i], circles_)) {
            off.push_back(static_cast<Index>(i));
            continue;
        }
        places[i] = preimage(images[i]);
        if (!(std::abs(image(places[i]) - images[i]) <= off_domain)) lost.push_back(static_cast<Index>(i));
    }
    if (!off.empty()) throw InputError("points lie off the circle domain (listed)", ElementKind::points, off);
    if (!lost.empty()) throw SolverError("points have no preimage that was found (listed)", ElementKind::points, lost);
    return places;
}

PlanarResult planar_map(const std::vector<PlanarRim>& rims, const PlanarOptions& options, ExecutionContext& context)
{
    const OrderedRims domain = ordered_rims(rims);
    const auto [middle, size] = box_of(domain.polygons[0]);
    const OrderedRims unit = scaled(domain, middle, size);

    PlanarResult best;
    std::vector<Circle> coarser;
    std::vector<double> residuals;
    bool was_compared = false;
    int levels = 0;
    for (const RimResolution& resolution : resolutions) {
        context.begin_stage("resolution " + std::to_string(levels + 1),
                            static_cast<double>(levels) / resolutions.size(),
                            static_cast<double>(levels + 1) / resolutions.size());
        KoebeIteration iteration(unit, resolution);
        if (iteration.most_work() > most_entries) {
            if (levels > 0) break;
            throw InputError("a rim has too many corners for a dense system");
        }
        iteration.run(options.max_sweeps, context);
        residuals = iteration.residuals();
        ++levels;
        const std::vector<Circle> found = iteration.circles();
        if (!(*std::ranges::max_element(residuals) < useless) || !circles_apart(found)) {
            coarser.clear();
            continue;
        }

        PlanarResult result;
        result.order = domain.order;
        result.circles = normalized_circles(found);
        result.module = conformal_module(result.circles);
        result.residuals = residuals;
        result.sweeps = iteration.sweeps + 1;
        result.unknowns = iteration.unknowns;
        estimate_errors(result, coarser);
        result.converged = !coarser.empty() && result.error <= options.tolerance;
        result.map = PlanarMap(middle, size, domain.polygons, std::move(iteration.maps), iteration.outer());
        result.map.normalize(normalizing_map(found), result.circles);
        // An error without a coarser resolution is a residual alone; and rounding may make finer ones worse.
        const bool is_better = !was_compared || result.converged || (!coarser.empty() && result.error < best.error);
        was_compared = was_compared || !coarser.empty();
        coarser = result.circles;
        if (is_better) best = std::move(result);
        if (best.converged) break;
    }
    context.begin_stage("circles", 1.0, 1.0);
    if (best.circles.empty()) refuse(residuals, domain.order);
    best.levels = levels;
    return best;
}

}  // namespace koebe
