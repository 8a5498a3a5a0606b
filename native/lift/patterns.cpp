#include "lift/patterns.h"

#include "core/errors.h"
#include "lift/even_sites.h"
#include "lift/lattice.h"
#include "lift/site_outlines.h"
#include "transfer/nearest_triangle.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace koebe {
namespace {

/// Finds the copy of an outline whose first point lies in the sheet. Others lie beyond its border, in no face.
void locate(const FlatSheet& sheet, std::vector<DrawnOutline>& outlines)
{
    std::vector<Complex> shifts{0.0};
    for (const Complex period : sheet.periods) {
        const std::size_t n = shifts.size();
        for (const int times : {-1, 1, -2, 2})
            for (std::size_t i = 0; i < n; ++i) shifts.push_back(shifts[i] + static_cast<double>(times) * period);
    }
    const Index count = static_cast<Index>(sheet.triangles.rows());
    PlanarPoints corners(3 * count, 2), points(static_cast<Eigen::Index>(outlines.size()), 2);
    Triangles faces(count, 3);
    for (Index c = 0; c < 3 * count; ++c) {
        corners.row(c) << sheet.uv[c].real(), sheet.uv[c].imag();
        faces.data()[c] = c;
    }
    std::vector<double> nearest(outlines.size(), 1e-12);  // no outline starts that near to two copies' borders
    for (const Complex shift : shifts) {
        for (std::size_t i = 0; i < outlines.size(); ++i) {
            const Complex z = outlines[i].points[0] + shift;
            points.row(static_cast<Eigen::Index>(i)) << z.real(), z.imag();
        }
        const PlacesInTriangles places = nearest_triangles(corners, faces, points);
        for (std::size_t i = 0; i < outlines.size(); ++i) {
            if (outlines[i].face >= 0 || !(places.distance[static_cast<Eigen::Index>(i)] < nearest[i])) continue;
            outlines[i].face = places.face[static_cast<Eigen::Index>(i)];
            for (Complex& z : outlines[i].points) z += shift;
        }
    }
}

/// Brings a place into the first period of a domain.
Complex first_copy(const std::vector<Complex>& periods, Complex z)
{
    if (periods.size() == 1) return z - std::floor(z.real() / periods[0].real()) * periods[0];
    if (periods.size() < 2) return z;
    const auto cross = [](Complex a, Complex b) { return a.real() * b.imag() - a.imag() * b.real(); };
    const double whole = cross(periods[0], periods[1]);
    return z - std::floor(cross(z, periods[1]) / whole) * periods[0] -
           std::floor(cross(periods[0], z) / whole) * periods[1];
}

DrawnPattern lattice_pattern(const FlatSheet& sheet, const std::string& name, const PatternOptions& options)
{
    Complex low = sheet.uv[0], high = sheet.uv[0];
    for (const Complex z : sheet.uv) {
        low = {std::min(low.real(), z.real()), std::min(low.imag(), z.imag())};
        high = {std::max(high.real(), z.real()), std::max(high.imag(), z.imag())};
    }
    const LaidLattice laid = lay_lattice(lattice_of(name, options.bridge / options.size), sheet.periods,
                                         options.size / sheet.mean_scale, options.repeats, low, high);
    DrawnPattern pattern;
    pattern.bend = laid.bend;
    for (const Complex place : laid.places)
        for (const std::vector<Complex>& shape : laid.shapes) {
            DrawnOutline outline;
            const Complex moved = first_copy(sheet.periods, place + shape[0]) - shape[0];
            for (const Complex z : shape) outline.points.push_back(moved + z);
            outline.group = static_cast<Index>(pattern.outlines.size());
            pattern.outlines.push_back(std::move(outline));
        }
    locate(sheet, pattern.outlines);
    std::erase_if(pattern.outlines, [](const DrawnOutline& outline) { return outline.face < 0; });
    for (std::size_t i = 0; i < pattern.outlines.size(); ++i) pattern.outlines[i].group = static_cast<Index>(i);
    return pattern;
}

}  // namespace

const std::vector<std::string>& pattern_names()
{
    static const std::vector<std::string> names{"circles", "hexagons", "triangles", "diamonds", "stripes", "voronoi"};
    return names;
}

DrawnPattern built_in_pattern(const FlatSheet& sheet, const std::string& name, const PatternOptions& options)
{
    if (std::ranges::find(pattern_names(), name) == pattern_names().end()) {
        std::string all;
        for (const std::string& one : pattern_names()) all += (all.empty() ? "" : ", ") + one;
        throw InputError("there is no pattern '" + name + "': the patterns are " + all);
    }
    if (!(options.bridge < 0.5 * options.size)) throw InputError("the bridge must be less than half of the size");
    const bool at_sites = name == "circles" || name == "voronoi";
    if (options.repeats > 0 && (at_sites || sheet.periods.size() != 1))
        throw InputError("repeats are for hexagons, triangles, diamonds and stripes on a ring");
    if (!at_sites) return lattice_pattern(sheet, name, options);
    return {site_outlines(sheet, even_sites(sheet, options.size, options.seed),
                          name == "circles" ? SiteShape::circles : SiteShape::voronoi, options.size, options.bridge)};
}

}  // namespace koebe
