#include "lift/lattice.h"

#include "core/errors.h"
#include "lift/outline.h"
#include "planar/planar_predicates.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace koebe {
namespace {

std::vector<Complex> regular_polygon(int corners, double inner_radius, double turn, Complex middle)
{
    std::vector<Complex> polygon;
    const double radius = inner_radius / std::cos(std::numbers::pi / corners);
    for (int k = 0; k < corners; ++k)
        polygon.push_back(middle + std::polar(radius, turn + 2.0 * std::numbers::pi * k / corners));
    return polygon;
}

/// A rectangle with half circles at its ends.
std::vector<Complex> slot(double width, double height, Complex middle)
{
    constexpr int arc = 12;
    std::vector<Complex> polygon;
    const double radius = 0.5 * width, straight = 0.5 * height - radius;
    for (int end = 0; end < 2; ++end)
        for (int k = 0; k <= arc; ++k)
            polygon.push_back(middle + Complex(0.0, end == 0 ? straight : -straight) +
                              std::polar(radius, std::numbers::pi * (end + static_cast<double>(k) / arc)));
    return polygon;
}

/// A quarter of a ring about a corner of the square [-1/2, 1/2]^2, with half circles at its ends.
/// @param corner as a sum of unit steps: (-1, -1) for the lower left one
std::vector<Complex> quarter_ring(double width, Complex corner)
{
    constexpr int arc = 16, cap = 8;
    constexpr double quarter = 0.5 * std::numbers::pi;
    const double apart = std::numbers::sqrt2 - 1.0;  // of the middles of the two rings
    const Complex first = -corner / std::abs(corner) * std::polar(1.0, -0.5 * quarter);  // along the square's side
    const auto at = [&](double radius, double angle) { return 0.5 * corner + radius * first * std::polar(1.0, angle); };
    const auto add_cap = [&](std::vector<Complex>& polygon, double angle, bool end) {
        for (int k = 1; k < cap; ++k) {
            const double turn = std::numbers::pi * k / cap + (end ? 0.0 : std::numbers::pi);
            polygon.push_back(at(0.5, angle) + 0.5 * width * first * std::polar(1.0, angle + turn));
        }
    };
    std::vector<Complex> polygon;
    for (int k = 0; k <= arc; ++k) polygon.push_back(at(0.5 + 0.5 * width, apart + (quarter - 2.0 * apart) * k / arc));
    add_cap(polygon, quarter - apart, true);
    for (int k = arc; k >= 0; --k) polygon.push_back(at(0.5 - 0.5 * width, apart + (quarter - 2.0 * apart) * k / arc));
    add_cap(polygon, apart, false);
    return polygon;
}

/// A linear map of the plane.
struct Linear {
    Complex of_one, of_i;
    Complex operator()(Complex z) const { return z.real() * of_one + z.imag() * of_i; }
};

/// The map that takes a to p and b to q.
Linear taking(Complex a, Complex b, Complex p, Complex q)
{
    const double whole = cross(a, b);
    return {(b.imag() * p - a.imag() * q) / whole, (-b.real() * p + a.real() * q) / whole};
}

double bend_of(const Linear& map)
{
    const Complex turning = 0.5 * (map.of_one - Complex(0.0, 1.0) * map.of_i);
    const Complex mirroring = 0.5 * (map.of_one + Complex(0.0, 1.0) * map.of_i);
    const double least = std::abs(turning) - std::abs(mirroring);
    return least > 0.0 ? (std::abs(turning) + std::abs(mirroring)) / least : INFINITY;
}

/// @param places of the lattice that will be laid
void require_few(const Lattice& lattice, double places)
{
    double points = 0.0;
    for (const std::vector<Complex>& shape : lattice.shapes) points += static_cast<double>(shape.size());
    require_few_outlines(places * static_cast<double>(lattice.shapes.size()), places * points,
                         "the size of the lattice's cells");
}

struct Fit {
    Linear map;
    std::array<std::array<long, 2>, 2> cells{};  // of each period, in the lattice
    double bend = INFINITY;
};

/// Whole numbers of cells for two periods, at the turn and size where the lattice is bent least.
Fit fit_torus(const Lattice& lattice, const std::vector<Complex>& periods, double size)
{
    Fit best;
    double least = INFINITY;
    // Turns of 1.5 degrees, sizes from -8 to 8 %.
    for (int i = 0; i < 120; ++i)
        for (int j = -8; j <= 8; ++j) {
            const Complex turn = std::polar(size * (1.0 + 0.01 * j), std::numbers::pi * i / 120.0);
            Fit fit;
            std::array<Complex, 2> sums;
            // The nearest whole numbers of cells for each period.
            for (int p = 0; p < 2; ++p) {
                const Complex z = periods[p] / turn;
                const double whole = cross(lattice.a, lattice.b);
                fit.cells[p] = {std::lround(cross(z, lattice.b) / whole), std::lround(cross(lattice.a, z) / whole)};
                sums[p] =
                    static_cast<double>(fit.cells[p][0]) * lattice.a + static_cast<double>(fit.cells[p][1]) * lattice.b;
            }
            if (!(cross(sums[0], sums[1]) * cross(periods[0], periods[1]) > 0.0)) continue;
            // The linear map that makes them fit exactly, and how much it bends; a little for the change of size.
            fit.map = taking(sums[0], sums[1], periods[0], periods[1]);
            fit.bend = bend_of(fit.map);
            const double cost = fit.bend + 0.02 * std::abs(j) * 0.1;
            if (!(cost < least)) continue;
            least = cost;
            best = fit;
        }
    if (!std::isfinite(best.bend)) throw InputError("the size is too large: not one cell fits the periods");
    return best;
}

/// All cells that differ on the torus, by the Hermite normal form of its periods.
void cells_of_torus(Fit fit, const Lattice& lattice, LaidLattice& laid)
{
    auto& [first, second] = fit.cells;
    while (second[0] != 0) {
        const long times = first[0] / second[0];
        for (int k = 0; k < 2; ++k) first[k] -= times * second[k];
        std::swap(first, second);
    }
    const long columns = std::abs(first[0]), rows = std::abs(second[1]);
    require_few(lattice, static_cast<double>(columns) * static_cast<double>(rows));
    for (long i = 0; i < columns; ++i)
        for (long j = 0; j < rows; ++j)
            laid.places.push_back(fit.map(static_cast<double>(i) * lattice.a + static_cast<double>(j) * lattice.b));
}

long cells_round(const Lattice& lattice, double period, double size, int repeats)
{
    const long columns = lattice.columns;
    if (repeats == 0) return std::max(1L, std::lround(period / (size * lattice.a.real())));
    if (repeats % columns == 0) return repeats / columns;
    const long below = repeats / columns * columns;
    throw InputError("the pattern does not meet itself after " + std::to_string(repeats) +
                     " repeats: " + (below > 0 ? std::to_string(below) + " or " : std::string()) +
                     std::to_string(below + columns) + " fit");
}

}  // namespace

Lattice lattice_of(const std::string& pattern, double bridge, bool along)
{
    const double side = std::sqrt(0.75);
    if (pattern == "hexagons")
        return {
            1.0, {0.5, side}, {rounded_corners(regular_polygon(6, 0.5 * (1.0 - bridge), std::numbers::pi / 6, 0.0))}};
    if (pattern == "triangles") {
        const double inner = side / 3.0;  // of a triangle of side 1
        const double left = inner - 0.5 * bridge;
        return {1.0,
                {0.5, side},
                {rounded_corners(regular_polygon(3, left, std::numbers::pi / 2, {0.5, inner})),
                 rounded_corners(regular_polygon(3, left, -std::numbers::pi / 2, {1.0, 2.0 * inner}))}};
    }
    if (pattern == "diamonds") {
        const double half = std::sqrt(0.5);  // of a diamond's side over its width, and its inner radius is half of that
        return {1.0, {0.5, 0.5}, {rounded_corners(regular_polygon(4, 0.5 * half * (1.0 - bridge), 0.0, 0.0))}};
    }
    if (pattern == "circles") return {1.0, {0.5, side}, {regular_polygon(48, 0.5 * (1.0 - bridge), 0.0, 0.0)}};
    if (pattern == "truchet") {
        const double width = std::numbers::sqrt2 - 1.0 - bridge;
        if (!(width > 0.02)) throw InputError("the bridge of truchet must be less than 0.39 of the size");
        return {1.0,
                {0.0, 1.0},
                {quarter_ring(width, {-1.0, -1.0}), quarter_ring(width, {1.0, 1.0})},
                1,
                {quarter_ring(width, {1.0, -1.0}), quarter_ring(width, {-1.0, 1.0})}};
    }
    std::vector<Complex> stripe = slot(1.0 - bridge, 4.0 - bridge, 0.0);
    if (!along) return {2.0, {1.0, 2.0}, {std::move(stripe)}, 2};
    for (Complex& z : stripe) z *= Complex(0.0, 1.0);
    return {4.0, {2.0, 1.0}, {std::move(stripe)}};
}

LaidLattice lay_lattice(const Lattice& lattice, const std::vector<Complex>& periods, double size, int repeats,
                        Complex low, Complex high)
{
    LaidLattice laid;
    Linear map{size, Complex(0.0, size)};
    if (periods.size() == 2) {
        const Fit fit = fit_torus(lattice, periods, size);
        map = fit.map;
        laid.bend = fit.bend;
        cells_of_torus(fit, lattice, laid);
    } else {
        double first = 0.0, last = 0.0;  // of a
        if (periods.size() == 1) {
            const long cells = cells_round(lattice, periods[0].real(), size, repeats);
            const Complex scale = periods[0] / (static_cast<double>(cells) * lattice.a);
            map = {scale, scale * Complex(0.0, 1.0)};
            laid.unit = std::abs(scale);
            last = static_cast<double>(cells);
        }
        const double rise = map(lattice.b).imag(), run = map(lattice.a).real(), lean = map(lattice.b).real();
        const Complex middle = 0.5 * (low + high);
        const double rows = std::ceil(0.5 * (high.imag() - low.imag()) / rise) + 1.0;
        const double reach = std::ceil(0.5 * (high.real() - low.real()) / run) + 1.0;
        require_few(lattice, (2.0 * rows + 1.0) * (periods.empty() ? 2.0 * reach + 3.0 : last));
        for (double j = -rows; j <= rows; ++j) {
            if (periods.empty()) {
                first = std::floor(-j * lean / run) - reach;
                last = first + 2.0 * reach + 2.0;
            }
            for (double i = first; i < last; ++i)
                laid.places.push_back((periods.empty() ? middle : Complex(0.0, middle.imag())) + i * map(lattice.a) +
                                      j * map(lattice.b));
        }
    }
    const auto laid_shapes = [&](std::vector<std::vector<Complex>> shapes) {
        for (std::vector<Complex>& shape : shapes)
            for (Complex& z : shape) z = map(z);
        return shapes;
    };
    laid.shapes = laid_shapes(lattice.shapes);
    laid.other_shapes = laid_shapes(lattice.other_shapes);
    return laid;
}

std::vector<Complex> rounded_corners(std::vector<Complex> polygon)
{
    for (int round = 0; round < 3; ++round) {
        std::vector<Complex> cut;
        const double part = round == 0 ? 0.12 : 0.25;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Complex a = polygon[i], b = polygon[(i + 1) % polygon.size()];
            cut.push_back(a + part * (b - a));
            cut.push_back(b - part * (b - a));
        }
        polygon = std::move(cut);
    }
    return polygon;
}

}  // namespace koebe
