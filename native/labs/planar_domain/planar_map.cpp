#include "planar_domain/planar_map.h"

#include "circles/crowded_circles.h"
#include "core/counted.h"
#include "core/errors.h"
#include "planar_domain/planar_iteration.h"
#include "shape/conformal_module.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

namespace koebe {
namespace {

constexpr RimResolution first_look{6, 3, 64};  // a tenth of the next one's time
constexpr std::array resolutions{RimResolution{14, 6, 128}, RimResolution{20, 9, 192}, RimResolution{28, 12, 256},
                                 RimResolution{38, 16, 384}, RimResolution{50, 20, 512}};
constexpr std::size_t most_entries = 40000000;  // of a system: 320 MB
constexpr double useless = 1e-3;                // residual: no circles
constexpr double unresolved = 0.1;              // residual of a rim's own map: more poles would not be enough
constexpr int mean_places = 48;                 // round a pole
constexpr double mean_share = 0.25;             // of the room round a pole
constexpr double off_domain = 1e-8;             // disk units: images so far off the circle domain are refused
constexpr double rounding = 1e-15;              // of a place, of the domain's size

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

/// The residuals that the rims' own maps have to be below at a resolution. With a greater one the finest resolution
/// would not resolve the rim, if residuals go on to fall as they did.
/// @param last residuals of the next coarser resolution, or empty @param left finer resolutions
std::vector<double> enough_for(std::size_t rims, const std::vector<double>& last, std::size_t left)
{
    std::vector<double> all(rims, unresolved);
    const double share = 1.0 / static_cast<double>(left + 1);  // now (now / last)^left < useless
    for (std::size_t k = 0; k < last.size(); ++k)
        all[k] = std::max(useless, std::pow(useless, share) * std::pow(last[k], 1.0 - share));
    return all;
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

/// What distances from circles become at most where an automorphism moves the circles: times its largest derivative.
std::vector<double> moved_residuals(std::vector<double> residuals, const std::vector<Circle>& circles,
                                    const Moebius& map)
{
    for (std::size_t k = 0; k < residuals.size(); ++k) {
        const double nearest =
            std::abs(1.0 - std::conj(map.a) * circles[k].center) - std::abs(map.a) * circles[k].radius;
        residuals[k] *= (1.0 - std::norm(map.a)) / (nearest * nearest);
    }
    return residuals;
}

void require_slits(const PlanarOptions& options, std::size_t rims)
{
    if (options.slits == SlitKind::none) return;
    const bool is_parallel = options.slits == SlitKind::parallel;
    if (!is_parallel && rims < 2) throw InputError("circular and radial slits need a domain with a hole");
    if (is_parallel != options.pole.has_value())
        throw InputError(is_parallel ? "parallel slits need a pole" : "only parallel slits have a pole");
    if (is_parallel && !std::isfinite(std::abs(*options.pole))) throw InputError("the pole is not finite");
}

/// @param coarser the map of the next coarser resolution, or one without circles
void add_slits(PlanarResult& result, PlanarMap coarser_map, const PlanarOptions& options)
{
    result.map.add_slits(options);
    result.slit_kind = options.slits;
    result.slits = result.map.slit_map()->slits();
    std::vector<Slit> coarser;
    if (!coarser_map.circles().empty()) {
        coarser_map.add_slits(options);
        coarser = coarser_map.slit_map()->slits();
    }
    double size = 0.0, change = 0.0;
    for (std::size_t k = 0; k < result.slits.size(); ++k) {
        const Slit& slit = result.slits[k];
        size = std::max({size, std::abs(slit.begin), std::abs(slit.end)});
        if (!coarser.empty())
            change = std::max({change, std::abs(slit.begin - coarser[k].begin), std::abs(slit.end - coarser[k].end)});
    }
    // The constants on the circles may be off by as much as two residuals from one to the next.
    const double constants = 2.0 * static_cast<double>(result.slits.size()) * result.map.slit_map()->residual();
    result.slit_error = std::max(change, constants) / size;
    result.converged = result.converged && !coarser.empty() && result.slit_error <= options.tolerance;
}

/// Whether a place lies in the circle domain, up to a distance. @param circles the unit circle, then the holes
bool lies_inside(Complex z, const std::vector<Circle>& circles, double off)
{
    return std::abs(z) <= 1.0 + off && std::all_of(circles.begin() + 1, circles.end(), [&](const Circle& hole) {
               return std::abs(z - hole.center) >= hole.radius - off;
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

void PlanarMap::add_slits(const PlanarOptions& options)
{
    SlitMap::Pole pole{0.0, 1.0, std::polar(1.0, options.slit_angle * std::numbers::pi / 180.0)};
    if (options.pole) {
        pole.place = (*this)(VectorXcd::Constant(1, *options.pole))[0];
        pole.residue = derivative(*options.pole);
        const bool on_rim = std::ranges::any_of(circles_, [&](const Circle& circle) {
            return std::abs(std::abs(pole.place - circle.center) - circle.radius) < off_domain;
        });
        if (on_rim) throw InputError("the pole is on a rim");
    }
    slit_map_.emplace(circles_, options.slits, pole);
    if (!options.pole) return;
    // Near the pole the map is 1 / (z - pole) + O(z - pole): the mean over a circle round it becomes 0.
    double room = std::numeric_limits<double>::infinity();
    for (const RimPolygon& rim : rims_) room = std::min(room, rim.distance(*options.pole));
    VectorXcd around(mean_places);
    for (int i = 0; i < mean_places; ++i)
        around[i] = *options.pole + std::polar(mean_share * room, 2.0 * std::numbers::pi * i / mean_places);
    slit_map_->move(-slit_images(around).mean());
}

void PlanarMap::normalize(const Moebius& last, std::vector<Circle> circles, double residual)
{
    last_ = last;
    circles_ = std::move(circles);
    off_ = std::max(off_domain, 2.0 * residual);
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
        bool inside = lies_inside(images[i], circles_, off_);
        if (!inside) {  // at corners a place as rounded may lie farther off; at the corner itself the slope is infinite
            const double slope = std::abs(derivative(places[i]));
            inside = !std::isfinite(slope) || lies_inside(images[i], circles_, off_ + rounding * size_ * slope);
        }
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

VectorXcd PlanarMap::slit_images(const VectorXcd& places) const
{
    if (!slit_map_) throw InputError("no slits were asked for");
    return (*this)(places).unaryExpr([this](Complex z) { return (*slit_map_)(z); });
}

VectorXcd PlanarMap::inverse(const VectorXcd& images) const
{
    VectorXcd places(images.size());
    std::vector<Index> off, lost;
    for (Eigen::Index i = 0; i < images.size(); ++i) {
        if (!lies_inside(images[i], circles_, off_)) {
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
    require_slits(options, rims.size());
    const OrderedRims domain = ordered_rims(rims);
    const auto [middle, size] = box_of(domain.polygons[0]);
    const OrderedRims unit = scaled(domain, middle, size);

    PlanarResult best;
    std::vector<Circle> coarser;
    PlanarMap last_map, coarser_map;  // coarser_map: the one that the best was compared with
    std::vector<double> residuals, residuals_of_rims;
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
        const std::size_t left = resolutions.size() - static_cast<std::size_t>(levels) - 1;
        const std::vector<double> enough = enough_for(rims.size(), residuals_of_rims, left);
        if (levels == 0) {
            KoebeIteration look(unit, first_look);
            if (!look.run(1, enough, context)) refuse(look.first_residuals, domain.order);
        }
        const bool is_resolved = iteration.run(options.max_sweeps, enough, context);
        ++levels;
        if (!is_resolved) {
            if (best.circles.empty()) residuals = iteration.first_residuals;
            break;
        }
        residuals_of_rims = iteration.first_residuals;
        residuals = iteration.residuals();
        const std::vector<Circle> found = iteration.circles();
        if (!(*std::ranges::max_element(residuals) < useless) || !circles_apart(found)) {
            coarser.clear();
            last_map = {};
            continue;
        }

        const Moebius last = normalizing_map(found);
        PlanarResult result;
        result.order = domain.order;
        result.circles = normalized_circles(found);
        result.module = conformal_module(result.circles);
        result.residuals = moved_residuals(residuals, found, last);
        result.sweeps = iteration.sweeps + 1;
        result.unknowns = iteration.unknowns;
        estimate_errors(result, coarser);
        result.converged = !coarser.empty() && result.error <= options.tolerance;
        result.map = PlanarMap(middle, size, domain.polygons, std::move(iteration.maps), iteration.outer());
        result.map.normalize(last, result.circles, *std::ranges::max_element(result.residuals));
        // An error without a coarser resolution is a residual alone; and rounding may make finer ones worse.
        const bool is_better = !was_compared || result.converged || (!coarser.empty() && result.error < best.error);
        was_compared = was_compared || !coarser.empty();
        coarser = result.circles;
        if (is_better) {
            coarser_map = std::move(last_map);
            best = std::move(result);
            last_map = best.map;
        } else {
            last_map = std::move(result.map);
        }
        if (best.converged) break;
    }
    context.begin_stage("circles", 1.0, 1.0);
    if (best.circles.empty()) refuse(residuals, domain.order);
    best.levels = levels;
    if (options.slits != SlitKind::none) add_slits(best, std::move(coarser_map), options);
    return best;
}

}  // namespace koebe
