#include "lift/patterns.h"

#include "core/errors.h"
#include "files/extension.h"
#include "lift/border_room.h"
#include "lift/even_sites.h"
#include "lift/lattice.h"
#include "lift/outline_places.h"
#include "lift/pattern_place.h"
#include "lift/site_outlines.h"
#include "planar/planar_predicates.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace koebe {
namespace {

constexpr double longest_piece = 0.05;  // of a side in the logarithm's plane, in radians: so that arcs look round

/// The plane that a lattice is laid in: the UVs, turned, or the logarithm about a hole of a disk.
struct LatticePlane {
    std::vector<Complex> periods;
    Complex low, high;
    double scale = 1.0;                  ///< length on the surface over length in the plane, in the mean
    Complex turn = 1.0;                  ///< from the plane to the UVs
    std::optional<Complex> middle = {};  ///< of the hole, in the hyperbolic plane: it goes to 0 before the logarithm

    Complex in_uv(Complex w) const
    {
        if (!middle) return turn * w;
        const Complex z = std::exp(Complex(0.0, 1.0) * w);
        return Complex(0.5, 0.5) + 0.5 * (z + *middle) / (1.0 + std::conj(*middle) * z);
    }
};

LatticePlane plane_of(const FlatSheet& sheet, Complex turn)
{
    std::vector<Complex> places = sheet.uv;
    for (Complex& z : places) z *= std::conj(turn);
    const PlaneBox box = box_around(places);
    return {sheet.periods, box.low, box.high, sheet.mean_scale, turn};
}

/// Angles run along the real axis, and from the rim at 0 the imaginary part grows towards the hole.
LatticePlane plane_about(const FlatSheet& sheet, const Circle& hole)
{
    const double distance = std::abs(hole.center);
    const double near = distance - hole.radius, far = distance + hole.radius;
    if (!(near > -1.0 && far < 1.0 && hole.radius > 0.0)) throw InputError("the hole is not inside the disk");
    const double middle = std::tanh(0.5 * (std::atanh(near) + std::atanh(far)));
    const double radius = (far - middle) / (1.0 - middle * far);
    LatticePlane plane;
    plane.middle = distance > 0.0 ? middle * hole.center / distance : Complex(0.0, 0.0);
    plane.periods = {2.0 * std::numbers::pi};
    plane.high = {2.0 * std::numbers::pi, -std::log(radius)};
    plane.scale = std::sqrt(sheet.area / (plane.high.real() * plane.high.imag()));
    return plane;
}

Complex middle_of(const std::vector<Complex>& shape)
{
    Complex sum = 0.0;
    for (const Complex z : shape) sum += z;
    return sum / static_cast<double>(shape.size());
}

/// A shape made smaller about its middle.
std::vector<Complex> smaller(std::vector<Complex> shape, double scale)
{
    const Complex middle = middle_of(shape);
    if (scale != 1.0)
        for (Complex& z : shape) z = middle + scale * (z - middle);
    return shape;
}

/// A shape of a lattice that is laid over a domain.
struct LaidShape {
    const std::vector<Complex>* shape;
    Complex place;
    double scale = 1.0;
};

/// An outline with its first copy in the UVs; in a curved plane its sides are divided.
std::vector<Complex> points_in_uv(const LatticePlane& plane, const LaidShape& laid)
{
    const std::vector<Complex> shape = smaller(*laid.shape, laid.scale);
    const Complex moved = first_copy(plane.periods, laid.place + shape[0]) - shape[0];
    double longest = 0.0;
    for (const Complex z : shape) longest = std::max(longest, distance(z, shape[0]));
    std::vector<Complex> points;
    for (std::size_t i = 0; i < shape.size(); ++i) {
        const Complex a = shape[i], way = shape[(i + 1) % shape.size()] - a;
        const double piece = std::min(0.1 * longest, longest_piece);
        const int pieces = plane.middle ? std::max(1, static_cast<int>(std::ceil(std::abs(way) / piece))) : 1;
        for (int k = 0; k < pieces; ++k)
            points.push_back(plane.in_uv(moved + a + way * (static_cast<double>(k) / pieces)));
    }
    return points;
}

/// A fair coin for each cell [SplitMix64; Steele, Lea, Flood 2014].
bool coin(std::uint64_t seed, std::uint64_t cell)
{
    std::uint64_t z = (seed * 0x2545F4914F6CDD1DULL + cell + 1) * 0x9E3779B97F4A7C15ULL;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return ((z >> 40) & 1) != 0;
}

/// Whether stripes run along the real axis of a plane that repeats there. @throws InputError a turn that does not fit
bool runs_along(const std::string& name, const PatternOptions& options)
{
    if (std::fmod(options.turn, name == "stripes" ? 90.0 : 360.0) != 0.0)
        throw InputError("on a ring and around a hole stripes turn by 90 degrees, and nothing else turns");
    return options.hole.has_value() == (std::fmod(options.turn, 180.0) == 0.0);
}

/// Moves the rows, so that the first one lies a bridge away from the hole, and drops those at the rim and beyond
/// `most`.
/// @param clipped whether rows go on over the rim
void begin_at_hole(LaidLattice& laid, const LatticePlane& plane, double rise, double bridge, int most, bool clipped)
{
    double top = -INFINITY, bottom = INFINITY;
    for (const auto* shapes : {&laid.shapes, &laid.other_shapes})
        for (const auto& shape : *shapes)
            for (const Complex z : shape) {
                top = std::max(top, z.imag());
                bottom = std::min(bottom, z.imag());
            }
    const double first = plane.high.imag() - bridge - top, near = 1e-6 * rise;
    const double rim = clipped ? -INFINITY : plane.low.imag() + bridge - bottom;
    const double last = std::max(rim, most > 0 ? first - (most - 1) * rise : -INFINITY);
    const Complex shift(0.0, std::fmod(first - laid.places.front().imag(), rise));
    for (Complex& place : laid.places) place += shift;
    std::erase_if(laid.places, [&](Complex z) { return z.imag() > first + near || z.imag() < last - near; });
}

/// Gives each shape the scale that the grade asks for, and that the border has room for.
void scale_shapes(const FlatSheet& sheet, const LatticePlane& plane, const PatternOptions& options,
                  std::vector<LaidShape>& shapes)
{
    if (sheet.grade.empty() && !options.whole) return;
    // Where each shape's middle lies on the sheet.
    std::vector<Complex> middles;
    for (const LaidShape& one : shapes) {
        const Complex middle = one.place + middle_of(*one.shape);
        middles.push_back(first_copy(sheet.periods, plane.in_uv(first_copy(plane.periods, middle))));
    }
    const std::vector<SheetPlace> nearest = places_in_sheet(sheet, middles, INFINITY);
    const BorderRoom room(sheet, options.size / sheet.mean_scale);
    // The grade there, and no more than leaves a bridge to the border.
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const SheetPlace& at = nearest[i];
        const double grade = sheet.grade_at(at.face, at.weights);
        shapes[i].scale = grade < least_grade ? 0.0 : grade;
        const bool on_surface = distance(sheet.uv_at(at.face, at.weights), middles[i] + at.shift) < 1e-9;
        if (!options.whole || !on_surface || shapes[i].scale == 0.0) continue;
        const double bridge = options.bridge / sheet.scale_at(at.face, at.weights);
        shapes[i].scale *= room.largest_scale(
            [&](double scale) {
                return points_in_uv(plane, {shapes[i].shape, shapes[i].place, scale * shapes[i].scale});
            },
            bridge);
    }
    std::erase_if(shapes, [](const LaidShape& one) { return one.scale == 0.0; });
}

/// Takes out the shapes that lie beyond the surface: it is farther from their middle than any of their points.
void drop_beyond(const FlatSheet& sheet, const LatticePlane& plane, std::vector<LaidShape>& shapes)
{
    std::vector<Complex> middles;
    double reach = 0.0;
    for (const LaidShape& one : shapes) {
        const Complex middle = middle_of(*one.shape);
        for (const Complex z : *one.shape) reach = std::max(reach, distance(z, middle));
        middles.push_back(first_copy(sheet.periods, plane.in_uv(first_copy(plane.periods, one.place + middle))));
    }
    const std::vector<SheetPlace> places = places_in_sheet(sheet, middles, (1.0 + 1e-9) * reach);
    std::size_t count = 0;
    for (std::size_t i = 0; i < shapes.size(); ++i)
        if (places[i].face >= 0) shapes[count++] = shapes[i];
    shapes.resize(count);
}

DrawnPattern lattice_pattern(const FlatSheet& sheet, const FlatSheet& walked, const std::string& name,
                             const PatternOptions& options)
{
    // The lattice in a plane in which it repeats: around a hole, along a ring, over a torus.
    const bool repeats = options.hole || sheet.periods.size() == 1, along = repeats && runs_along(name, options);
    const LatticePlane plane = options.hole ? plane_about(sheet, *options.hole)
                                            : plane_of(sheet, repeats ? Complex(1.0) : unit_turn(options.turn));
    const double bridge = options.bridge / options.size;
    const Lattice lattice = lattice_of(name, bridge, along);
    // Its places and the shapes there, by chance where the pattern has two kinds of cells.
    LaidLattice laid =
        lay_lattice(lattice, plane.periods, options.size / plane.scale, options.repeats, plane.low, plane.high);
    if (options.hole)
        begin_at_hole(laid, plane, laid.unit * lattice.b.imag(), laid.unit * bridge, options.rows, &walked != &sheet);
    DrawnPattern pattern;
    pattern.bend = laid.bend;
    std::vector<LaidShape> shapes;
    for (std::size_t i = 0; i < laid.places.size(); ++i)
        for (const auto& shape : laid.other_shapes.empty() || coin(options.seed, i) ? laid.shapes : laid.other_shapes)
            shapes.push_back({&shape, laid.places[i]});
    if (&walked != &sheet && !plane.middle) drop_beyond(sheet, plane, shapes);
    // To scale, in the UVs, on the faces.
    scale_shapes(sheet, plane, options, shapes);
    for (const LaidShape& one : shapes) pattern.outlines.push_back({points_in_uv(plane, one)});
    locate_outlines(walked, pattern.outlines);
    std::erase_if(pattern.outlines, [](const DrawnOutline& outline) { return outline.face < 0; });
    for (std::size_t i = 0; i < pattern.outlines.size(); ++i) pattern.outlines[i].group = static_cast<Index>(i);
    return pattern;
}

bool at_sites(const std::string& name) { return name == "circles" || name == "voronoi"; }

SiteShape shape_of(const std::string& name) { return name == "circles" ? SiteShape::circles : SiteShape::voronoi; }

void require_pattern(const std::string& name, const PatternOptions& options)
{
    if (std::ranges::find(pattern_names(), name) == pattern_names().end()) {
        std::string all;
        for (const std::string& one : pattern_names()) all += (all.empty() ? "" : ", ") + one;
        throw InputError("there is no pattern '" + name + "': the patterns are " + all +
                         ", or an SVG, PNG or OBJ file");
    }
    if (!(options.bridge < 0.5 * options.size)) throw InputError("the bridge must be less than half of the size");
    if (options.turn != 0.0 && at_sites(name) && !options.hole)
        throw InputError("circles and Voronoi cells have no turn");
}

}  // namespace

const std::vector<std::string>& pattern_names()
{
    static const std::vector<std::string> names{"circles", "hexagons", "triangles", "diamonds",
                                                "stripes", "truchet",  "voronoi"};
    return names;
}

bool is_pattern_file(const std::string& pattern)
{
    const std::string extension = io::lower_extension(pattern);
    return extension == ".svg" || extension == ".png" || extension == ".obj";
}

DrawnPattern built_in_pattern(const FlatSheet& sheet, const std::string& name, const PatternOptions& options,
                              const FlatSheet* filled)
{
    const FlatSheet& walked = filled ? *filled : sheet;
    require_pattern(name, options);
    if (options.hole && name == "voronoi") throw InputError("Voronoi cells have no rows to lie around a hole");
    if (options.repeats > 0 && !options.hole && (at_sites(name) || sheet.periods.size() != 1))
        throw InputError("repeats are for hexagons, triangles, diamonds, stripes and truchet on a ring");
    if (options.turn != 0.0 && sheet.periods.size() == 2)
        throw InputError("a lattice on a torus is turned so that it meets itself: leave the turn out");
    if (options.hole || !at_sites(name)) return lattice_pattern(sheet, walked, name, options);
    return {site_outlines(walked, even_sites(sheet, options.size, options.seed), shape_of(name), options.size,
                          options.bridge)};
}

DrawnPattern built_in_pattern_on_sphere(const SphereSheets& sheets, const std::string& name,
                                        const PatternOptions& options)
{
    require_pattern(name, options);
    if (!at_sites(name))
        throw InputError("a lattice of " + name +
                         " does not close on a sphere: circles, voronoi, drawings, images and meshes do");
    if (options.repeats > 0)
        throw InputError("repeats are for hexagons, triangles, diamonds, stripes and truchet on a ring");
    return {site_outlines_on_sphere(sheets, even_sites(sheets.home, options.size, options.seed), shape_of(name),
                                    options.size, options.bridge)};
}

}  // namespace koebe
