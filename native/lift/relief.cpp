#include "lift/relief.h"

#include <algorithm>
#include <limits>
#include <unordered_map>

namespace koebe {
namespace {

double distance_to(const Overlay& overlay, const std::vector<Index>& loop, Index vertex)
{
    double nearest = std::numeric_limits<double>::infinity();
    for (const Index other : loop)
        nearest = std::min(nearest, (overlay.vertices.row(other) - overlay.vertices.row(vertex)).norm());
    return nearest;
}

/// Where a place on the way from an outline's first point lies: its face, and the shift to that face's chart.
bool holds_first_point(const FlatSheet& sheet, const Outline& outline, Index face)
{
    return (sheet.weights_of(face, outline.points[0]).array() >= 0.0).all();
}

/// Walks from the outline's face to the one that holds the first point of the inner outline, over the faces between.
bool locate_inner(const FlatSheet& sheet, Outline& inner)
{
    std::vector<std::pair<Index, Complex>> front{{inner.face, 0.0}};
    std::unordered_map<Index, char> seen{{inner.face, 1}};
    const std::vector<Complex> points = inner.points;
    for (std::size_t i = 0; i < front.size() && i < 100000; ++i) {
        const auto [face, offset] = front[i];
        for (std::size_t k = 0; k < points.size(); ++k) inner.points[k] = points[k] + offset;
        if (holds_first_point(sheet, inner, face)) {
            inner.face = face;
            return true;
        }
        for (Index h = 3 * face; h < 3 * face + 3; ++h)
            if (!sheet.border[h] && seen.emplace(face_of(sheet.twin[h]), 1).second)
                front.emplace_back(face_of(sheet.twin[h]), offset + sheet.step[h]);
    }
    return false;
}

}  // namespace

std::vector<Outline> with_inner_outlines(const FlatSheet& sheet, const std::vector<Outline>& outlines, double share)
{
    std::vector<Outline> both;
    for (const Outline& outline : outlines) {
        Complex middle = 0.0;
        for (const Complex z : outline.points) middle += z / static_cast<double>(outline.points.size());
        Outline inner = outline;
        inner.inner = true;
        for (Complex& z : inner.points) z += share * (middle - z);
        both.push_back(outline);
        if (inner.face >= 0 && !locate_inner(sheet, inner)) both.back().face = inner.face = -1;
        both.push_back(std::move(inner));
    }
    return both;
}

VectorXd relief_heights(const Overlay& overlay)
{
    VectorXd heights = VectorXd::Zero(overlay.vertices.rows());
    std::unordered_map<Index, std::array<Index, 2>> rings;  // of a group: its outer and its inner outline
    for (Index o = 0; o < static_cast<Index>(overlay.outlines.size()); ++o)
        rings[overlay.outlines[o].group][overlay.outlines[o].inner ? 1 : 0] = o;
    for (const bool inner : {false, true})  // vertices of an inner outline belong to it
        for (std::size_t f = 0; f < overlay.region.size(); ++f) {
            const Index o = overlay.region[f];
            if (o < 0 || overlay.outlines[o].inner != inner) continue;
            const auto& [outer_loop, inner_loop] = rings[overlay.outlines[o].group];
            for (const Index v : overlay.triangles.row(static_cast<Eigen::Index>(f))) {
                if (inner) {
                    heights[v] = 1.0;
                } else if (heights[v] == 0.0) {
                    const double out = distance_to(overlay, overlay.loops[outer_loop], v);
                    heights[v] = out > 0.0 ? out / (out + distance_to(overlay, overlay.loops[inner_loop], v)) : 0.0;
                }
            }
        }
    return heights;
}

}  // namespace koebe
