#include "lift/placed_drawing.h"

#include "core/errors.h"
#include "core/sort_unique.h"
#include "lift/border_room.h"
#include "lift/outline_places.h"
#include "planar/filled_paths.h"
#include "planar/planar_predicates.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace koebe {
namespace {

constexpr std::size_t most_corners = 200000;
constexpr double of_drawing = 1e-3, of_mean_edge = 0.05, least_of_drawing = 2e-5;  // tolerances of curves
constexpr int sides = 64;  // at least, so that an outline is led through vertices that lie near

double mean_uv_edge(const FlatSheet& sheet)
{
    double sum = 0.0;
    for (Index h = 0; h < static_cast<Index>(sheet.uv.size()); ++h)
        sum += distance(sheet.uv[h], sheet.uv[3 * (h / 3) + (h + 1) % 3]);
    return sum / static_cast<double>(sheet.uv.size());
}

/// The boundaries of the united paths.
std::vector<FilledBoundary> united(const SvgDrawing& drawing, double tolerance)
{
    std::size_t corners = 0;
    const auto filled = [&](const std::vector<SvgPath>& given) {
        std::vector<FilledPath> paths;
        for (const SvgPath& path : given) {
            paths.push_back({path.even_odd, flattened(path, tolerance), path.clips});
            for (const auto& ring : paths.back().rings) corners += ring.size();
            if (corners > most_corners)
                throw InputError("the drawing has over " + std::to_string(most_corners) +
                                 " corners: simplify its paths");
        }
        return paths;
    };
    std::vector<std::vector<FilledPath>> clips;
    for (const std::vector<SvgPath>& clip : drawing.clips) clips.push_back(filled(clip));
    return united_paths(filled(drawing.paths), clips);
}

/// Moves all curves: z to factor (z - centre).
void move_curves(SvgDrawing& drawing, Complex centre, Complex factor)
{
    const auto move = [&](std::vector<SvgPath>& paths) {
        for (SvgPath& path : paths)
            for (auto& curve : path.curves)
                for (Complex& z : curve) z = factor * (z - centre);
    };
    move(drawing.paths);
    std::ranges::for_each(drawing.clips, move);
}

/// A box around the drawing as it is cut.
PlaneBox drawn_box(const SvgDrawing& drawing)
{
    std::vector<Complex> all;
    if (drawing.clips.empty()) {
        for (const SvgPath& path : drawing.paths)
            for (const auto& polygon : flattened(path, of_drawing))
                all.insert(all.end(), polygon.begin(), polygon.end());
    } else {
        for (const FilledBoundary& boundary : united(drawing, of_drawing))
            all.insert(all.end(), boundary.points.begin(), boundary.points.end());
    }
    if (all.empty()) throw InputError("the clip paths and masks of the drawing leave nothing of it");
    return box_around(all);
}

/// The paths turned, with the box's middle at 0 and its width 1.
SvgDrawing in_unit_width(SvgDrawing drawing, double degrees)
{
    const auto largest = [](Complex size) { return std::max(size.real(), size.imag()); };
    move_curves(drawing, 0.5 * drawing.low + 0.5 * drawing.high, 1.0);
    move_curves(drawing, 0.0, unit_turn(degrees) / largest(drawing.high - drawing.low));
    PlaneBox box = drawn_box(drawing);
    while (largest(box.size()) < 0.5 && box.size().real() > 0.0) {  // clips leave a small part: it is seen closer
        move_curves(drawing, box.middle(), 1.0 / largest(box.size()));
        box = drawn_box(drawing);
    }
    if (!(box.size().real() > 0.0 && box.size().imag() > 0.0))
        throw InputError("the drawing has no width or no height, or is too large");
    move_curves(drawing, box.middle(), 1.0 / box.size().real());
    drawing.low = (box.low - box.middle()) / box.size().real();
    drawing.high = (box.high - box.middle()) / box.size().real();
    return drawing;
}

/// The boundaries of the united paths, their long sides divided.
std::vector<FilledBoundary> drawn_boundaries(const SvgDrawing& drawing, double tolerance)
{
    std::vector<FilledBoundary> boundaries = united(drawing, tolerance);
    for (FilledBoundary& boundary : boundaries) {
        const std::vector<Complex> points = std::move(boundary.points);
        double length = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i) length += distance(points[i], points[(i + 1) % points.size()]);
        boundary.points.clear();
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Complex a = points[i], b = points[(i + 1) % points.size()];
            const int parts = std::max(1, static_cast<int>(std::ceil(sides * distance(a, b) / length)));
            for (int k = 0; k < parts; ++k) boundary.points.push_back(a + (b - a) * (static_cast<double>(k) / parts));
        }
        if (boundary.hole) std::ranges::reverse(boundary.points);  // outlines are counter-clockwise
    }
    return boundaries;
}

/// Takes out areas that lie in a hole of another one.
void drop_areas_in_holes(std::vector<FilledBoundary>& boundaries)
{
    std::vector<std::pair<PlaneBox, std::vector<Complex>>> holes;
    for (const FilledBoundary& boundary : boundaries)
        if (boundary.hole) holes.emplace_back(box_around(boundary.points), boundary.points);
    std::vector<char> inner(boundaries.size(), 0);
    for (const FilledBoundary& boundary : boundaries) {
        if (boundary.hole) continue;
        const Complex z = boundary.points.front();
        for (const auto& [box, polygon] : holes)
            if (z.real() >= box.low.real() && z.real() <= box.high.real() && z.imag() >= box.low.imag() &&
                z.imag() <= box.high.imag() && runs_round(polygon, z))
                inner[boundary.area] = 1;
    }
    std::erase_if(boundaries, [&](const FilledBoundary& boundary) { return inner[boundary.area] != 0; });
}

/// Makes areas smaller about the middles of their boxes, with their holes, where the border has no room for them.
/// @param width of the drawing in the UVs
void fit_beside_border(const FlatSheet& sheet, double width, double bridge, std::vector<DrawnOutline>& outlines)
{
    const BorderRoom room(sheet, 0.1 * width);
    std::ranges::stable_sort(outlines, {}, &DrawnOutline::group);
    for (auto first = outlines.begin(); first != outlines.end();) {
        const auto last =
            std::find_if(first, outlines.end(), [&](const DrawnOutline& other) { return other.group != first->group; });
        const auto outer = std::ranges::find(first, last, false, &DrawnOutline::hole);
        if (outer == last) throw std::logic_error("an area of a drawing has no outer boundary");
        const PlaneBox box = box_around(outer->points);
        const auto smaller_by = [&](std::vector<Complex> points, double scale) {
            for (Complex& z : points) z = box.middle() + scale * (z - box.middle());
            return points;
        };
        const double least = 0.01 * std::max(box.size().real(), box.size().imag());
        const double scale =
            room.largest_scale([&](double s) { return smaller_by(outer->points, s); }, std::max(bridge, least));
        if (scale != 1.0)
            for (auto one = first; one != last; ++one) one->points = smaller_by(std::move(one->points), scale);
        first = last;
    }
}

/// Takes out the holes, and notes where they begin.
void drop_holes(PlacedDrawing& placed)
{
    for (const DrawnOutline& outline : placed.outlines) {
        if (!outline.hole) continue;
        ++placed.islands;
        if (outline.face >= 0) placed.island_faces.push_back(outline.face);
    }
    std::erase_if(placed.outlines, [](const DrawnOutline& outline) { return outline.hole; });
    std::vector<Index>& faces = placed.island_faces;
    sort_unique(faces);
}

}  // namespace

PlacedDrawing placed_drawing(const FlatSheet& sheet, const FlatSheet& filled, const SvgDrawing& given,
                             const PatternPlace& place, bool cut_out, std::optional<double> least_bridge)
{
    const SvgDrawing drawing = in_unit_width(given, place.turn);
    const PlacedFrame frame = placed_frame(sheet, drawing.high.imag() - drawing.low.imag(), place, "drawing");
    const double tolerance = std::clamp(of_mean_edge * mean_uv_edge(sheet) / frame.width, least_of_drawing, of_drawing);
    // The areas that the drawing fills, once.
    std::vector<FilledBoundary> boundaries = drawn_boundaries(drawing, tolerance);
    if (cut_out) drop_areas_in_holes(boundaries);
    if (boundaries.size() * frame.centres.size() > most_corners)
        throw InputError("the repeated drawing has over " + std::to_string(most_corners) + " outlines");

    // Copies of them at all centres of the frame.
    PlacedDrawing placed;
    placed.size = frame.width * frame.scale;
    Index group = 0;
    for (const Complex centre : frame.centres) {
        Index areas = 0;
        for (const FilledBoundary& boundary : boundaries) {
            DrawnOutline outline;
            for (const Complex z : boundary.points) outline.points.push_back(centre + frame.width * z);
            const Complex shift = first_copy(sheet.periods, outline.points[0]) - outline.points[0];
            for (Complex& z : outline.points) z += shift;
            outline.group = group + boundary.area;
            outline.hole = boundary.hole;
            areas = std::max(areas, boundary.area + 1);
            placed.outlines.push_back(std::move(outline));
        }
        group += areas;
    }
    if (least_bridge) fit_beside_border(sheet, frame.width, *least_bridge / frame.scale, placed.outlines);
    locate_outlines(filled, placed.outlines);
    if (cut_out) drop_holes(placed);
    return placed;
}

}  // namespace koebe
