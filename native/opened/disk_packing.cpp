#include "opened/disk_packing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace koebe {
namespace {

constexpr double room = 1.04;        // dimensionless: a disk's square is so much wider than the disk
constexpr double next_width = 1.01;  // dimensionless: widths that are tried, each so many times the last

struct Rows {
    std::vector<Circle> disks;
    double height = 0.0;
};

Rows rows_of(const std::vector<double>& radii, const std::vector<std::size_t>& order, double width)
{
    Rows rows{std::vector<Circle>(radii.size())};
    double x = 0.0, tallest = 0.0;
    for (const std::size_t i : order) {
        const double half = room * radii[i];
        if (x > 0.0 && x + 2.0 * half > width) {
            rows.height += tallest;
            x = tallest = 0.0;
        }
        rows.disks[i] = {Complex(x + half, rows.height + half), radii[i]};
        x += 2.0 * half;
        tallest = std::max(tallest, 2.0 * half);
    }
    rows.height += tallest;
    return rows;
}

}  // namespace

std::vector<Circle> pack_disks(const std::vector<double>& radii)
{
    if (radii.size() <= 1) return std::vector<Circle>(radii.size(), Circle{});
    std::vector<std::size_t> order(radii.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t i) { return radii[i]; });
    double area = 0.0;
    for (const double radius : radii) area += 4.0 * room * room * radius * radius;
    double width = std::max(2.0 * room * radii[order[0]] * (1.0 + 1e-12), std::sqrt(area));
    Rows best = rows_of(radii, order, width);
    double side = std::max(width, best.height);
    while ((width *= next_width) < side)
        if (Rows rows = rows_of(radii, order, width); std::max(width, rows.height) < side) {
            side = std::max(width, rows.height);
            best = std::move(rows);
        }
    for (Circle& disk : best.disks) {
        disk.center = 2.0 * disk.center / side - Complex(1.0, 1.0);
        disk.radius *= 2.0 / side;
    }
    return best.disks;
}

}  // namespace koebe
