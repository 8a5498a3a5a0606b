#include "lift/site_outlines.h"

#include "lift/even_sites.h"
#include "lift/lattice.h"
#include "planar/planar_predicates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace koebe {
namespace {

constexpr int circle_points = 64;
constexpr double least_share = 0.3;  // of the size: outlines that are smaller are left out

/// Points in squares, to find those near a place.
class PlaneGrid {
public:
    explicit PlaneGrid(double cell) : cell_(cell) {}
    void add(Complex place, Index number) { cells_[cell_of(place)].emplace_back(place, number); }
    template <typename Visit>
    void near(Complex place, double reach, Visit&& visit) const
    {
        const auto low = cell_of(place - Complex(reach, reach)), high = cell_of(place + Complex(reach, reach));
        for (long x = low.first; x <= high.first; ++x)
            for (auto cell = cells_.lower_bound({x, low.second});
                 cell != cells_.end() && cell->first <= std::pair(x, high.second); ++cell)
                for (const auto& [other, number] : cell->second)
                    if (distance(other, place) < reach) visit(other, number);
    }

private:
    std::pair<long, long> cell_of(Complex z) const
    {
        return {std::lround(std::floor(z.real() / cell_)), std::lround(std::floor(z.imag() / cell_))};
    }
    double cell_;
    std::map<std::pair<long, long>, std::vector<std::pair<Complex, Index>>> cells_;
};

/// The sums of periods, up to three of each.
std::vector<Complex> shifts_of(const FlatSheet& sheet)
{
    std::vector<Complex> shifts{0.0};
    for (const Complex period : sheet.periods) {
        const std::size_t n = shifts.size();
        for (int times : {-1, 1})
            for (std::size_t i = 0; i < n; ++i) shifts.push_back(shifts[i] + static_cast<double>(times) * period);
    }
    return shifts;
}

/// Points along the border in the UVs, no farther apart than `apart`, each with its sheet's number.
PlaneGrid border_points(const FlatSheet& sheet, double apart)
{
    PlaneGrid grid(apart);
    for (Index h = 0; h < static_cast<Index>(sheet.uv.size()); ++h) {
        if (!sheet.border[h] || !(sheet.twice_area(face_of(h)) > 0.0)) continue;
        const Complex a = sheet.uv[h], edge = sheet.uv[next_halfedge(h)] - a;
        const double pieces = std::min(1e3, std::ceil(4.0 * std::abs(edge) / apart));
        for (double i = 0.0; i < std::max(1.0, pieces); ++i)
            for (const Complex shift : shifts_of(sheet))
                grid.add(a + (i / std::max(1.0, pieces)) * edge + shift, sheet.sheet[face_of(h)]);
    }
    return grid;
}

/// The part of a convex polygon where dot(z - foot, normal) <= 0.
std::vector<Complex> clipped(const std::vector<Complex>& polygon, Complex foot, Complex normal)
{
    std::vector<Complex> result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Complex a = polygon[i], b = polygon[(i + 1) % polygon.size()];
        const double at_a = dot(a - foot, normal), at_b = dot(b - foot, normal);
        if (at_a <= 0.0) result.push_back(a);
        if ((at_a < 0.0 && at_b > 0.0) || (at_a > 0.0 && at_b < 0.0))
            result.push_back(a + at_a / (at_a - at_b) * (b - a));
    }
    return result;
}

struct Site {
    Complex place;
    Index face, sheet;
    double size, bridge;  // in the UVs around it; on a sphere as seen from it
};

class Neighbourhood {
public:
    Neighbourhood(const FlatSheet& sheet, const std::vector<Site>& sites, double apart, bool on_sphere)
        : border_(border_points(sheet, apart)), sites_(sites), grid_(apart), on_sphere_(on_sphere)
    {
        for (std::size_t i = 0; i < sites.size(); ++i)
            for (const Complex shift : shifts_of(sheet)) grid_.add(sites[i].place + shift, static_cast<Index>(i));
    }

    std::vector<Complex> circle(const Site& site) const
    {
        double radius = 0.5 * (site.size - site.bridge);
        around(site, site.size, [&](Complex way, bool at_border) {
            const double room = std::sqrt(std::norm(way));
            radius = std::min(radius, at_border ? room - site.bridge : 0.5 * (room - site.bridge));
        });
        if (!(radius > 0.5 * least_share * site.size)) return {};
        std::vector<Complex> points;
        for (int k = 0; k < circle_points; ++k)
            points.push_back(std::polar(radius, 2.0 * std::numbers::pi * k / circle_points));
        return placed(site, points);
    }

    std::vector<Complex> cell(const Site& site) const
    {
        std::vector<Complex> polygon;
        for (int k = 0; k < 12; ++k) polygon.push_back(std::polar(1.2 * site.size, std::numbers::pi * k / 6.0));
        double room = std::numeric_limits<double>::infinity();  // to the cell's sides
        around(site, 2.5 * site.size, [&](Complex way, bool at_border) {
            const double length = std::abs(way);
            const double side = at_border ? length - site.bridge : 0.5 * (length - site.bridge);
            room = std::min(room, side);
            if (side > 0.0) polygon = clipped(polygon, side / length * way, way);
        });
        if (!(room > 0.5 * least_share * site.size) || polygon.size() < 3) return {};
        return placed(site, rounded_corners(without_short_sides(polygon, 0.02 * site.size)));
    }

private:
    template <typename Visit>
    void around(const Site& site, double reach, Visit&& visit) const
    {
        const auto see = [&](Complex other, bool at_border) {
            const Complex way = on_sphere_ ? seen_from(site.place, other) : other - site.place;
            if (std::abs(way) < reach) visit(way, at_border);
        };
        const double in_uv = on_sphere_ ? reach_on_sphere(site, reach) : reach;
        grid_.near(site.place, in_uv, [&](Complex other, Index number) {
            if (other != site.place && sites_[number].sheet == site.sheet) see(other, false);
        });
        border_.near(site.place, in_uv, [&](Complex other, Index sheet) {
            if (sheet == site.sheet) see(other, true);
        });
    }

    /// In the UVs of a chart, to reach at least as far as a circle about the site that is seen from there.
    static double reach_on_sphere(const Site& site, double reach)
    {
        const double from_middle = 2.0 * std::abs(site.place - Complex(0.5, 0.5));
        return magnified(site.place) * reach / std::max(0.1, 1.0 - from_middle * reach);
    }

    /// Points around a site in the UVs.
    std::vector<Complex> placed(const Site& site, const std::vector<Complex>& points) const
    {
        std::vector<Complex> result;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Complex a = points[i], way = points[(i + 1) % points.size()] - a;
            const double pieces = on_sphere_ ? std::max(1.0, std::ceil(std::abs(way) / (0.1 * site.size))) : 1.0;
            for (double k = 0.0; k < pieces; ++k) {
                const Complex z = a + (k / pieces) * way;
                result.push_back(on_sphere_ ? seen_back(site.place, z) : site.place + z);
            }
        }
        return result;
    }

    static std::vector<Complex> without_short_sides(const std::vector<Complex>& polygon, double least)
    {
        std::vector<Complex> kept;
        for (const Complex z : polygon)
            if (kept.empty() || distance(z, kept.back()) > least) kept.push_back(z);
        while (kept.size() > 3 && distance(kept.front(), kept.back()) <= least) kept.pop_back();
        return kept;
    }

    PlaneGrid border_;
    const std::vector<Site>& sites_;
    PlaneGrid grid_;
    bool on_sphere_;
};

/// The face that holds an outline's first point, on the straight way from the site. @return -1 beyond the border
Index face_towards(const FlatSheet& sheet, const Site& site, std::vector<Complex>& points)
{
    Index face = site.face;
    Complex from = site.place, offset = 0.0;
    Index entered = no_twin;
    for (Eigen::Index count = 0; count < sheet.triangles.size(); ++count) {
        const Complex to = points[0] + offset;
        Index out = no_twin;
        double least = std::numeric_limits<double>::infinity();
        // The edge by which the straight way leaves the face first.
        for (Index h = 3 * face; h < 3 * face + 3; ++h) {
            const Complex a = sheet.uv[h], edge = sheet.uv[next_halfedge(h)] - a;
            if (cross(edge, to - a) >= 0.0 || h == entered) continue;
            const double share = cross(a - from, edge) / cross(to - from, edge);
            if (share < least) {
                least = share;
                out = h;
            }
        }
        if (out == no_twin) break;
        if (sheet.border[out]) return -1;
        // Across it, UVs go on with the step of the edge.
        offset += sheet.step[out];
        from += sheet.step[out];
        entered = sheet.twin[out];
        face = face_of(entered);
    }
    for (Complex& z : points) z += offset;
    return face;
}

std::vector<DrawnOutline> outlines_around(const FlatSheet& sheet, const std::vector<Site>& sites,
                                          const std::vector<char>& drawn, SiteShape shape, double apart, bool on_sphere)
{
    const Neighbourhood around(sheet, sites, apart, on_sphere);
    std::vector<DrawnOutline> outlines;
    for (std::size_t i = 0; i < sites.size(); ++i) {
        if (!drawn[i]) continue;
        DrawnOutline outline{shape == SiteShape::circles ? around.circle(sites[i]) : around.cell(sites[i])};
        if (outline.points.empty()) continue;
        outline.face = face_towards(sheet, sites[i], outline.points);
        outline.group = static_cast<Index>(outlines.size());
        outlines.push_back(std::move(outline));
    }
    return outlines;
}

}  // namespace

std::vector<DrawnOutline> site_outlines(const FlatSheet& sheet, const std::vector<SurfacePoint>& points,
                                        SiteShape shape, double size, double bridge)
{
    std::vector<Site> sites;
    for (const SurfacePoint& point : points) {
        const double scale = sheet.scale_at(point.face, point.weights);
        const double own = size * std::max(least_grade, sheet.grade_at(point.face, point.weights));
        sites.push_back(
            {sheet.uv_at(point.face, point.weights), point.face, sheet.sheet[point.face], own / scale, bridge / scale});
    }
    return outlines_around(sheet, sites, std::vector<char>(sites.size(), 1), shape, size / sheet.mean_scale, false);
}

std::vector<DrawnOutline> site_outlines_on_sphere(const SphereSheets& sheets, const std::vector<SurfacePoint>& points,
                                                  SiteShape shape, double size, double bridge)
{
    const double apart = size / (sheets.home.mean_scale * 2.0 * sheets.home_scale);  // a chart's UVs are half as large
    std::vector<DrawnOutline> outlines;
    for (const int chart : {0, 1}) {
        const FlatSheet& sheet = sheets.charts[chart];
        std::vector<Site> sites;
        std::vector<char> drawn;
        for (const SurfacePoint& point : points) {
            if (!(sheet.twice_area(point.face) > 0.0)) continue;  // at the other pole
            const Complex place = sheet.uv_at(point.face, point.weights);
            const double scale = sheet.scale_at(point.face, point.weights) * magnified(place);
            const double own = size * std::max(least_grade, sheet.grade_at(point.face, point.weights));
            sites.push_back({place, point.face, sheet.sheet[point.face], own / scale, bridge / scale});
            drawn.push_back(sheets.in_south(point.face) == (chart == 1) ? 1 : 0);
        }
        for (DrawnOutline& outline : outlines_around(sheet, sites, drawn, shape, apart, true)) {
            outline.chart = chart;
            outline.group = static_cast<Index>(outlines.size());
            outlines.push_back(std::move(outline));
        }
    }
    return outlines;
}

}  // namespace koebe
