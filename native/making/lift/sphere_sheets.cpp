#include "lift/sphere_sheets.h"

#include "core/connectivity.h"
#include "core/errors.h"
#include "core/sort_unique.h"
#include "mesh/connected_pieces.h"
#include "planar/boundary_crossings.h"
#include "planar/planar_predicates.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace koebe {
namespace {

constexpr double visible = 8.0;      // a chart ends here in the plane of projection: 14 degrees from the opposite point
constexpr double disk_room = 0.248;  // radius of the disks in the unit square
constexpr std::array<Complex, 2> disk_middles{Complex(0.25, 0.5), Complex(0.75, 0.5)};

SpherePoint turned_south(const SpherePoint& p) { return {p[0], -p[1], -p[2]}; }

/// The rotation that takes a point to the north pole, and the north upwards.
Eigen::Matrix3d turn_to_north(const SpherePoint& point)
{
    SpherePoint up = SpherePoint(0.0, 0.0, 1.0) - point[2] * point;
    if (up.norm() < 1e-6) up = SpherePoint(0.0, 1.0, 0.0) - point[1] * point;
    up.normalize();
    Eigen::Matrix3d turn;
    turn << up.cross(point).transpose(), up.transpose(), point.transpose();
    return turn;
}

/// (V) places in the plane of projection.
std::vector<Complex> projected(const Vertices& points, const Eigen::Matrix3d& turn)
{
    std::vector<Complex> places;
    places.reserve(static_cast<std::size_t>(points.rows()));
    for (Eigen::Index v = 0; v < points.rows(); ++v) places.push_back(in_plane(turn * points.row(v).transpose()));
    return places;
}

double twice_area_of(const Triangles& triangles, const std::vector<Complex>& places, Index f)
{
    const Complex a = places[triangles(f, 0)];
    return cross(places[triangles(f, 1)] - a, places[triangles(f, 2)] - a);
}

bool seen_whole(const Triangles& triangles, const std::vector<Complex>& places, Index f)
{
    for (int k = 0; k < 3; ++k)
        if (!(std::abs(places[triangles(f, k)]) < visible)) return false;
    return twice_area_of(triangles, places, f) > 0.0;
}

FlatSheet chart_of(const Vertices& vertices, const Triangles& triangles, const std::vector<Complex>& places)
{
    PlanarPoints uv = PlanarPoints::Zero(triangles.size(), 2);
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f) {
        if (!seen_whole(triangles, places, f)) continue;
        for (int k = 0; k < 3; ++k) {
            const Complex w = places[triangles(f, k)];
            uv.row(3 * f + k) << 0.5 + 0.5 * w.real(), 0.5 + 0.5 * w.imag();
        }
    }
    return flat_sheet(vertices, triangles, uv);
}

class Halves {
public:
    Halves(const Triangles& triangles, const Vertices& points, const std::array<std::vector<Complex>, 2>& places)
        : triangles_(triangles), places_(places), twin_(pair_halfedges(triangles, static_cast<Index>(points.rows())))
    {
        for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f) {
            double height = 0.0;
            for (int k = 0; k < 3; ++k) height += points(triangles(f, k), 2);
            const int side = height < 0.0 ? 1 : 0;
            south_.push_back(fits(f, side) || !fits(f, 1 - side) ? side : 1 - side);
        }
        join_small_parts(0);
        join_small_parts(1);
    }

    const std::vector<int>& south() const { return south_; }

    /// Faces that are not upright, and those at rims that cross: there the halves are not one to one.
    std::vector<Index> faults() const
    {
        std::vector<Index> faults;
        for (Index f = 0; f < static_cast<Index>(south_.size()); ++f)
            if (!fits(f, south_[f]) && longest(f) > 1e-5) faults.push_back(f);
        Index count = 0;
        const std::vector<Index> part = connected_pieces(twin_, south_, count);
        // Each half: its rims do not cross, are not nested, and run round it once.
        for (const int side : {0, 1}) {
            PlanarPoints points(static_cast<Eigen::Index>(places_[side].size()), 2);
            for (std::size_t v = 0; v < places_[side].size(); ++v) {
                const Complex w = std::abs(places_[side][v]) < visible ? places_[side][v] : Complex(0.0, 0.0);
                points.row(static_cast<Eigen::Index>(v)) << w.real(), w.imag();
            }
            std::vector<std::pair<Index, VertexLoop>> rims = rims_of(side, part);
            std::vector<VertexLoop> all;
            for (const auto& [number, loop] : rims) all.push_back(loop);
            bool bad = loops_cross(all, points, 1e-6) || any_nested(side, part, rims) || any_sectors_overlap(side);
            while (!rims.empty() && !bad) {
                const Index number = rims.front().first;
                std::vector<VertexLoop> own;
                for (const auto& [other, loop] : rims)
                    if (other == number) own.push_back(loop);
                std::erase_if(rims, [&](const auto& rim) { return rim.first == number; });
                bad = !turned_loops(own, points, 1e-6).empty();
            }
            if (!bad) continue;
            for (Index h = 0; h < static_cast<Index>(twin_.size()); ++h)
                if (south_[face_of(h)] == side && at_rim(h)) faults.push_back(face_of(h));
        }
        sort_unique(faults);
        return faults;
    }

private:
    bool fits(Index f, int side) const { return seen_whole(triangles_, places_[side], f); }

    double longest(Index f) const
    {
        double longest = 0.0;
        for (int k = 0; k < 3; ++k)
            longest = std::max(longest, distance(places_[south_[f]][triangles_(f, k)],
                                                 places_[south_[f]][triangles_(f, (k + 1) % 3)]));
        return longest;
    }

    bool at_rim(Index h) const { return twin_[h] == no_twin || south_[face_of(twin_[h])] != south_[face_of(h)]; }

    /// Small parts of a half that lie in the other half go over to it.
    void join_small_parts(int side)
    {
        Index count = 0;
        const std::vector<Index> part = connected_pieces(twin_, south_, count);
        std::vector<Index> sizes(count, 0);
        for (const Index p : part) ++sizes[p];
        std::vector<char> of_side(count, 0), stays(count, 0), meets_hole(count, 0);
        Index largest = -1;
        for (Index f = 0; f < static_cast<Index>(part.size()); ++f) {
            if (south_[f] != side) continue;
            of_side[part[f]] = 1;
            if (!fits(f, 1 - side)) stays[part[f]] = 1;
            for (Index h = 3 * f; h < 3 * f + 3; ++h)
                if (twin_[h] == no_twin) meets_hole[part[f]] = 1;
            if (largest < 0 || sizes[part[f]] > sizes[largest]) largest = part[f];
        }
        for (Index f = 0; f < static_cast<Index>(part.size()); ++f)
            if (of_side[part[f]] && part[f] != largest && !stays[part[f]] && !meets_hole[part[f]]) south_[f] = 1 - side;
    }

    /// The loops around a half, each with the number of its part.
    std::vector<std::pair<Index, VertexLoop>> rims_of(int side, const std::vector<Index>& part) const
    {
        std::vector<std::pair<Index, VertexLoop>> rims;
        std::vector<char> seen(twin_.size(), 0);
        for (Index h = 0; h < static_cast<Index>(twin_.size()); ++h) {
            if (south_[face_of(h)] != side || !at_rim(h) || seen[h]) continue;
            VertexLoop loop;
            Index g = h;
            do {
                seen[g] = 1;
                loop.push_back(origin(triangles_, g));
                g = next_halfedge(g);
                while (!at_rim(g)) g = next_halfedge(twin_[g]);
            } while (g != h);
            rims.emplace_back(part[face_of(h)], std::move(loop));
        }
        return rims;
    }

    /// Whether a part of a half lies inside another one: their rims do not cross, and faces are covered twice.
    bool any_nested(int side, const std::vector<Index>& part,
                    const std::vector<std::pair<Index, VertexLoop>>& rims) const
    {
        const std::vector<Complex>& places = places_[side];
        std::map<Index, Complex> middles;  // of a face of each part
        for (Index f = 0; f < static_cast<Index>(south_.size()); ++f)
            if (south_[f] == side)
                middles.try_emplace(
                    part[f], (places[triangles_(f, 0)] + places[triangles_(f, 1)] + places[triangles_(f, 2)]) / 3.0);
        return std::ranges::any_of(middles, [&](const auto& own) {
            int turns = 0;
            for (const auto& [number, loop] : rims)
                for (std::size_t i = 0; number != own.first && i < loop.size(); ++i) {
                    const Complex a = places[loop[i]], b = places[loop[(i + 1) % loop.size()]], m = own.second;
                    if ((a.imag() <= m.imag()) == (b.imag() <= m.imag())) continue;
                    const bool up = b.imag() > m.imag();
                    if ((cross(b - a, m - a) > 0.0) == up) turns += up ? 1 : -1;
                }
            return turns != 0;
        });
    }

    /// Whether faces cover a place twice beside a vertex where a rim touches a rim: there they share it, and do not
    /// cross.
    bool any_sectors_overlap(int side) const
    {
        constexpr double whole = 2.0 * std::numbers::pi, near = 1e-9;
        std::map<Index, std::vector<std::array<double, 2>>> sectors;  // at a vertex: their begin and width
        for (Index h = 0; h < static_cast<Index>(twin_.size()); ++h) {
            if (south_[face_of(h)] != side || !at_rim(h)) continue;
            const Index v = origin(triangles_, h);
            Index last = h;
            bool upright = fits(face_of(h), side);
            while (!at_rim(previous_halfedge(last))) {
                last = twin_[previous_halfedge(last)];
                upright &= fits(face_of(last), side);
            }
            const Complex from = places_[side][target(triangles_, h)] - places_[side][v];
            const double width =
                std::arg((places_[side][origin(triangles_, previous_halfedge(last))] - places_[side][v]) / from);
            if (upright) sectors[v].push_back({std::arg(from), width > 0.0 ? width : width + whole});
        }
        return std::ranges::any_of(sectors, [&](auto& at) {
            auto& list = at.second;
            std::ranges::sort(list);
            for (std::size_t i = 0; list.size() > 1 && i < list.size(); ++i) {
                const double next = i + 1 < list.size() ? list[i + 1][0] : list[0][0] + whole;
                if (list[i][1] > next - list[i][0] + near) return true;
            }
            return false;
        });
    }

    const Triangles& triangles_;
    const std::array<std::vector<Complex>, 2>& places_;
    std::vector<Index> twin_;
    std::vector<int> south_;
};

}  // namespace

SphereSheets sphere_sheets(const Vertices& vertices, const Triangles& triangles, const Vertices& points,
                           std::optional<Index> around)
{
    // Stereographic projections from both poles; each face belongs to one half.
    Eigen::Matrix3d south = Eigen::Matrix3d::Identity();
    south(1, 1) = south(2, 2) = -1.0;
    const std::array<std::vector<Complex>, 2> places{projected(points, Eigen::Matrix3d::Identity()),
                                                     projected(points, south)};
    const Halves halves(triangles, points, places);
    if (std::vector<Index> faults = halves.faults(); !faults.empty())
        throw InputError("faces are too large on the sphere: subdivide the mesh", ElementKind::faces,
                         std::move(faults));

    // Both halves as disks of one size, beside each other in the UV square.
    double reach = 1.0;
    const auto place_of = [&](Index f, int k) { return places[halves.south()[f]][triangles(f, k)]; };
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f)
        for (int k = 0; k < 3; ++k) reach = std::max(reach, std::abs(place_of(f, k)));
    SphereSheets sheets;
    sheets.home_scale = disk_room / std::min(reach, visible);
    PlanarPoints uv(triangles.size(), 2);
    for (Index f = 0; f < static_cast<Index>(triangles.rows()); ++f)
        for (int k = 0; k < 3; ++k) {
            const Complex z = disk_middles[halves.south()[f]] + sheets.home_scale * place_of(f, k);
            uv.row(3 * f + k) << z.real(), z.imag();
        }
    sheets.home = flat_sheet(vertices, triangles, uv);
    for (const auto& plane : places) sheets.charts.push_back(chart_of(vertices, triangles, plane));
    if (around)
        sheets.charts.push_back(
            chart_of(vertices, triangles, projected(points, turn_to_north(points.row(*around).transpose()))));
    return sheets;
}

SpherePoint point_at_home(double home_scale, Complex uv)
{
    const bool in_south = uv.real() > 0.5;
    const SpherePoint point = on_sphere((uv - disk_middles[in_south ? 1 : 0]) / home_scale);
    return in_south ? turned_south(point) : point;
}

Complex seen_from(Complex middle, Complex place)
{
    const Complex a = 2.0 * middle - Complex(1.0, 1.0), w = 2.0 * place - Complex(1.0, 1.0);
    return (w - a) / (1.0 + std::conj(a) * w);
}

Complex seen_back(Complex middle, Complex seen)
{
    const Complex a = 2.0 * middle - Complex(1.0, 1.0);
    return Complex(0.5, 0.5) + 0.5 * (seen + a) / (1.0 - std::conj(a) * seen);
}

double magnified(Complex middle) { return 0.5 * (1.0 + std::norm(2.0 * middle - Complex(1.0, 1.0))); }

}  // namespace koebe
