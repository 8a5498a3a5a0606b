#include "lift/patterns.h"

#include "core/errors.h"
#include "io/extension.h"
#include "lift/even_sites.h"
#include "lift/lattice.h"
#include "lift/outline_places.h"
#include "lift/site_outlines.h"

#include <algorithm>
#include <utility>

namespace koebe {
namespace {

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
    locate_outlines(sheet, pattern.outlines);
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

bool is_pattern_file(const std::string& pattern)
{
    const std::string extension = io::lower_extension(pattern);
    return extension == ".svg" || extension == ".png";
}

DrawnPattern built_in_pattern(const FlatSheet& sheet, const std::string& name, const PatternOptions& options)
{
    if (std::ranges::find(pattern_names(), name) == pattern_names().end()) {
        std::string all;
        for (const std::string& one : pattern_names()) all += (all.empty() ? "" : ", ") + one;
        throw InputError("there is no pattern '" + name + "': the patterns are " + all + ", or an SVG or PNG file");
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
