#include "opened/disk_packing.h"

#include "core/errors.h"
#include "core/numbering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace koebe {
namespace {

constexpr int size_digits = 12;          // binary digits to which the largest size is found
constexpr int most_halvings = 2000;      // of the size: then no double is left
constexpr std::size_t most_nested = 16;  // more disks are slow to nest, and rows waste little space then
constexpr double touching = 1e-12;       // units of the square: rounding error of a touching place
constexpr double next_width = 0.99;      // ratio of a row width to the one tried before
constexpr double least_width = 0.8;      // of the square

using Centers = std::vector<Complex>;  // none: the disks do not fit

/// Centres at which a disk touches two walls, a wall and a disk, or two disks.
Centers touching_places(const Centers& centers, const std::vector<double>& radii, double radius)
{
    const std::array<double, 2> walls{radius, 1.0 - radius};
    Centers places;
    // Two walls: the corners.
    for (const double x : walls)
        for (const double y : walls) places.emplace_back(x, y);
    for (std::size_t i = 0; i < centers.size(); ++i) {
        // A wall and a disk: (x - c)^2 + (y - d)^2 = reach^2 on the wall.
        const double reach = radii[i] + radius, x = centers[i].real(), y = centers[i].imag();
        for (const double wall : walls)
            for (const double sign : {-1.0, 1.0}) {
                if (const double across = reach * reach - (wall - x) * (wall - x); across >= 0.0)
                    places.emplace_back(wall, y + sign * std::sqrt(across));
                if (const double across = reach * reach - (wall - y) * (wall - y); across >= 0.0)
                    places.emplace_back(x + sign * std::sqrt(across), wall);
            }
        // Two disks: where the circles of their reach cross.
        for (std::size_t j = i + 1; j < centers.size(); ++j) {
            const double other = radii[j] + radius, distance = std::abs(centers[j] - centers[i]);
            const double along = (distance * distance + reach * reach - other * other) / (2.0 * distance);
            const double across = reach * reach - along * along;
            if (!(across >= 0.0)) continue;
            const Complex step = (centers[j] - centers[i]) / distance;
            for (const double sign : {-1.0, 1.0})
                places.push_back(centers[i] + (along + sign * Complex(0.0, 1.0) * std::sqrt(across)) * step);
        }
    }
    return places;
}

/// Disks of falling radius, each in the lowest place where it touches two walls or disks.
Centers nested(const std::vector<double>& radii)
{
    Centers centers;
    for (const double radius : radii) {
        const auto has_room = [&](const Complex& place) {
            for (const double x : {place.real(), place.imag()})
                if (!(x >= radius - touching && x <= 1.0 - radius + touching)) return false;
            for (std::size_t i = 0; i < centers.size(); ++i)
                if (std::abs(place - centers[i]) - (radii[i] + radius) < -touching) return false;
            return true;
        };
        Centers places = touching_places(centers, radii, radius);
        std::erase_if(places, std::not_fn(has_room));
        if (places.empty()) return {};
        centers.push_back(*std::ranges::min_element(
            places, {}, [](const Complex& place) { return std::pair(place.imag(), place.real()); }));
    }
    return centers;
}

/// Disks of falling radius in rows of a given width, from the bottom.
Centers in_rows(const std::vector<double>& radii, double width)
{
    Centers centers;
    double x = 0.0, y = 0.0, height = 0.0;
    for (const double radius : radii) {
        if (x + 2.0 * radius > width) {
            y += height;
            x = height = 0.0;
        }
        if (x + 2.0 * radius > width || y + 2.0 * radius > 1.0) return {};
        centers.emplace_back(x + radius, y + radius);
        x += 2.0 * radius;
        height = std::max(height, 2.0 * radius);
    }
    return centers;
}

Centers placed(const std::vector<double>& radii)
{
    if (radii.size() <= most_nested) return nested(radii);
    for (double width = 1.0; width > least_width; width *= next_width)
        if (Centers centers = in_rows(radii, width); !centers.empty()) return centers;
    return {};
}

}  // namespace

std::vector<Circle> pack_disks(const std::vector<double>& radii, double margin)
{
    if (!std::ranges::all_of(radii, [](double radius) { return radius > 0.0 && std::isfinite(radius); }))
        throw InputError("disks to pack need positive radii");
    if (radii.size() <= 1) return std::vector<Circle>(radii.size(), Circle{Complex(0.5, 0.5), 0.5});
    margin = std::min(margin, 0.5 / static_cast<double>(radii.size()));
    // Large disks first: small ones fit between them.
    std::vector<std::size_t> order = numbers_below<std::size_t>(radii.size());
    std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t i) { return radii[i]; });
    const double largest = radii[order.front()];
    // Bisection of the common scale.
    double low = 0.0, high = 0.5;
    Centers centers;
    for (int k = 0; k < most_halvings && (centers.empty() || high - low > std::ldexp(high, -size_digits)); ++k) {
        const double scale = 0.5 * (low + high);
        std::vector<double> with_margin;
        for (const std::size_t i : order) with_margin.push_back(radii[i] / largest * scale + 0.5 * margin);
        if (Centers tried = placed(with_margin); tried.empty())
            high = scale;
        else {
            low = scale;
            centers = std::move(tried);
        }
    }
    std::vector<Circle> disks(radii.size());
    for (std::size_t k = 0; k < centers.size(); ++k) disks[order[k]] = {centers[k], low * (radii[order[k]] / largest)};
    return disks;
}

double margin_in_square(double margin, int pixels)
{
    if (pixels < 1) throw InputError("the texture needs at least one pixel");
    if (!(margin >= 0.0) || !std::isfinite(margin)) throw InputError("the margin must not be negative");
    return margin / pixels;
}

}  // namespace koebe
