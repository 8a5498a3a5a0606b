#include "lift/border_room.h"

#include "lift/pattern_place.h"
#include "planar/planar_predicates.h"

#include <algorithm>
#include <cmath>

namespace koebe {
namespace {

constexpr double scale_step = 0.05, least_scale = 0.3;  // dimensionless

double distance_to_segment(Complex z, Complex a, Complex b)
{
    const Complex way = b - a;
    const double length = std::norm(way);
    const double share = length > 0.0 ? std::clamp(dot(way, z - a) / length, 0.0, 1.0) : 0.0;
    return distance(z, a + share * way);
}

bool segments_near(Complex a, Complex b, Complex c, Complex d, double reach)
{
    return segments_meet(a, b, c, d) || distance_to_segment(a, c, d) < reach || distance_to_segment(b, c, d) < reach ||
           distance_to_segment(c, a, b) < reach || distance_to_segment(d, a, b) < reach;
}

}  // namespace

BorderRoom::BorderRoom(const FlatSheet& sheet, double cell) : cell_(cell)
{
    constexpr double most_squares = 4096.0;  // of one edge: a longer one lies in larger squares
    for (Index h = 0; h < static_cast<Index>(sheet.uv.size()); ++h)
        if (sheet.border[h]) cell_ = std::max(cell_, distance(sheet.uv[h], sheet.uv[next_halfedge(h)]) / most_squares);
    const std::vector<Complex> shifts = period_shifts(sheet.periods);
    for (Index h = 0; h < static_cast<Index>(sheet.uv.size()); ++h) {
        if (!sheet.border[h] || !(sheet.twice_area(face_of(h)) > 0.0)) continue;
        for (const Complex shift : shifts) {
            const Edge edge{sheet.uv[h] + shift, sheet.uv[next_halfedge(h)] + shift};
            const PlaneBox box = box_around({edge.a, edge.b});
            const auto low = square_of(box.low), high = square_of(box.high);
            for (long x = low.first; x <= high.first; ++x)
                for (long y = low.second; y <= high.second; ++y) squares_[{x, y}].push_back(edge);
        }
    }
}

std::pair<long, long> BorderRoom::square_of(Complex z) const
{
    return {std::lround(std::floor(z.real() / cell_)), std::lround(std::floor(z.imag() / cell_))};
}

bool BorderRoom::fits(const std::vector<Complex>& polygon, double bridge) const
{
    const PlaneBox box = box_around(polygon);
    const Complex reach(bridge, bridge);
    const auto low = square_of(box.low - reach), high = square_of(box.high + reach);
    for (long x = low.first; x <= high.first; ++x)
        for (auto square = squares_.lower_bound({x, low.second});
             square != squares_.end() && square->first <= std::pair(x, high.second); ++square)
            for (const Edge& edge : square->second) {
                if (runs_round(polygon, edge.a)) return false;
                for (std::size_t i = 0; i < polygon.size(); ++i)
                    if (segments_near(polygon[i], polygon[(i + 1) % polygon.size()], edge.a, edge.b, bridge))
                        return false;
            }
    return true;
}

double BorderRoom::largest_scale(const std::function<std::vector<Complex>(double scale)>& polygon, double bridge) const
{
    for (double scale = 1.0; scale > least_scale - 1e-9; scale -= scale_step)
        if (fits(polygon(scale), bridge)) return scale;
    return 1.0;
}

bool runs_round(const std::vector<Complex>& polygon, Complex z)
{
    bool inside = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Complex a = polygon[i] - z, b = polygon[(i + 1) % polygon.size()] - z;
        if ((a.imag() > 0.0) != (b.imag() > 0.0) && (cross(a, b) > 0.0) == (b.imag() > a.imag())) inside = !inside;
    }
    return inside;
}

}  // namespace koebe
