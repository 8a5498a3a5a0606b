#include "hard/loose_strips.h"

#include "core/connectivity.h"
#include "core/grouping.h"
#include "core/numbering.h"
#include "cost/tolerances.h"
#include "mesh/connected_pieces.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace koebe {
namespace {

constexpr double long_side = 0.3;        // of its outline lie at its plate,
constexpr double plate_to_strip = 2.0;   // which is so many times larger,
constexpr double much_shorter = 3.0;     // and pieces at its ends are so many times shorter,
constexpr double turned = 0.906;         // or turned against it: cosine of 25 degrees
constexpr double bent = 0.985;           // cosine of 10 degrees: pieces of a chart that run in another direction
constexpr double worth_bending = 0.005;  // of the strip's area: so large are these at least, a corner between strips

/// A planar piece of a chart.
struct Strip {
    double area = 0.0, outline = 0.0, inner = 0.0;  ///< length of the outline, of the edges to other pieces
    double longest = 0.0;
    Complex direction = 0.0;  ///< of the longest border or edge, as laid, by twice its angle
    bool at_plate = false;
};

bool runs_along(const Strip& a, const Strip& b, double cosine)
{
    return std::real(a.direction * std::conj(b.direction)) > 2.0 * cosine * cosine - 1.0;
}

Complex twice_turned(Complex edge)
{
    const double length = std::abs(edge);
    return length > 0.0 ? edge / length * (edge / length) : Complex(0.0);
}

}  // namespace

std::vector<Index> edges_of_loose_strips(const CutSurface& surface, const PlanarRegions& regions,
                                         const SeamedMesh& chart, const std::vector<Complex>& at)
{
    Index count = 0;
    const std::vector<Index> piece = connected_pieces(chart.twin, values_at(regions.of, chart.face), count);
    if (count < 2) return {};
    const auto in_surface = [&](Index h) { return 3 * chart.face[face_of(h)] + h % 3; };
    std::vector<Strip> strips(static_cast<std::size_t>(count));
    std::vector<std::map<Index, std::pair<double, Complex>>> borders(strips.size());  // with regions outside
    for (std::size_t f = 0; f < piece.size(); ++f) strips[piece[f]].area += surface.areas[chart.face[f]];
    for (Index h = 0; h < chart.halfedge_count(); ++h) {
        Strip& own = strips[piece[face_of(h)]];
        const Index t = chart.twin[h], here = in_surface(h), outside = surface.surface.twin[here];
        if (t != no_twin && piece[face_of(t)] == piece[face_of(h)]) continue;
        const double length = surface.lengths[here];
        const Complex edge = at[next_halfedge(here)] - at[here];
        own.outline += length;
        if (length > own.longest) {
            own.longest = length;
            own.direction = twice_turned(edge);
        }
        if (t != no_twin) {
            own.inner += length;
        } else if (outside != no_twin) {
            auto& [sum, along] = borders[piece[face_of(h)]][regions.of[face_of(outside)]];
            sum += length;
            along += edge;
        }
    }
    for (std::size_t p = 0; p < strips.size(); ++p) {
        Strip& own = strips[p];
        if (own.inner > tolerance::rolled_outline * own.outline) continue;
        double longest = long_side * own.outline;
        for (const auto& [region, border] : borders[p])
            if (border.first >= longest && regions.planes[region].area > plate_to_strip * own.area) {
                own.at_plate = true;
                own.longest = longest = border.first;
                own.direction = twice_turned(border.second);
            }
    }
    // A strip from which the chart goes on straight is not loose.
    std::vector<char> is_loose(strips.size(), 0);
    for (std::size_t p = 0; p < strips.size(); ++p) {
        if (!strips[p].at_plate) continue;
        double other = 0.0;
        for (const Strip& strip : strips)
            if (!runs_along(strip, strips[p], bent)) other += strip.area;
        is_loose[p] = other > worth_bending * strips[p].area;
    }
    std::vector<Index> edges;
    for (Index h = 0; h < chart.halfedge_count(); ++h) {
        const Index t = chart.twin[h], own = piece[face_of(h)], other = t == no_twin ? own : piece[face_of(t)];
        if (own == other || !is_loose[own]) continue;
        const Strip &a = strips[own], &b = strips[other];
        if (chart.whole[h] || !(0.5 * b.outline * much_shorter < a.longest || !runs_along(a, b, turned)))
            is_loose[own] = 0;
    }
    for (Index h = 0; h < chart.halfedge_count(); ++h) {
        const Index t = chart.twin[h], own = piece[face_of(h)], other = t == no_twin ? own : piece[face_of(t)];
        if (own != other && t > h && (is_loose[own] || is_loose[other])) edges.push_back(h);
    }
    return edges;
}

}  // namespace koebe
