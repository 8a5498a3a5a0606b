#include "surface/mirror.h"

#include "core/sort_unique.h"
#include "surface/mirror_plane.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace koebe {
namespace {

constexpr double off_mirror = 1e-4;      // of the diagonal: largest distance of a corner from its mirror image
constexpr double most_in_plane = 0.5;    // share of the corners: the plane of a flat surface is not its mirror
constexpr double cell_in_reaches = 4.0;  // width of a cell, in search radii

/// Finds the nearest of some points with a grid of cells.
class NearestPoint {
public:
    NearestPoint(const Vertices& points, double reach) : points_(points), reach_(reach)
    {
        for (Eigen::Index i = 0; i < points.rows(); ++i) {
            const Eigen::RowVector3d place = points.row(i);
            cells_[key(cell(place[0]), cell(place[1]), cell(place[2]))].push_back(static_cast<Index>(i));
        }
    }
    /// The nearest point within reach of a place, the first of equally near points; -1 if there is none.
    Index at(const Eigen::RowVector3d& place) const
    {
        std::array<std::int64_t, 3> low{}, high{};
        for (int k = 0; k < 3; ++k) {
            low[k] = cell(place[k] - reach_);
            high[k] = cell(place[k] + reach_);
        }
        Index found = -1;
        double near = reach_;
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
            for (std::int64_t y = low[1]; y <= high[1]; ++y)
                for (std::int64_t z = low[2]; z <= high[2]; ++z) {
                    const auto it = cells_.find(key(x, y, z));
                    if (it == cells_.end()) continue;
                    for (const Index i : it->second) {
                        const double away = (points_.row(i) - place).norm();
                        if (!(away < near || (away == near && i < found))) continue;
                        near = away;
                        found = i;
                    }
                }
        return found;
    }

private:
    std::int64_t cell(double x) const
    {
        return static_cast<std::int64_t>(std::floor(std::clamp(x / (cell_in_reaches * reach_), -1e15, 1e15)));
    }
    static std::uint64_t key(std::int64_t x, std::int64_t y, std::int64_t z)
    {
        std::uint64_t hash = 0;
        for (const std::int64_t c : {x, y, z}) hash = (hash ^ static_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15ULL;
        return hash;
    }
    const Vertices& points_;
    double reach_;
    std::unordered_map<std::uint64_t, std::vector<Index>> cells_;
};

/// Polygons and their corners, each vertex once. They do not depend on the diagonals.
struct PolygonCorners {
    std::vector<Index> group;                 // (F)
    std::vector<std::vector<Index>> corners;  // of each polygon, ascending
    Vertices middles;                         // of each polygon's corners
    double diagonal = 0.0;                    // of the box round all corners
};

PolygonCorners polygon_corners(const Vertices& vertices, const Triangles& triangles, const std::vector<Index>& polygon)
{
    PolygonCorners found;
    std::unordered_map<Index, Index> number;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const Index named = polygon.empty() ? static_cast<Index>(f) : polygon[static_cast<std::size_t>(f)];
        found.group.push_back(number.try_emplace(named, static_cast<Index>(number.size())).first->second);
    }
    found.corners.resize(number.size());
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        for (int k = 0; k < 3; ++k) found.corners[found.group[static_cast<std::size_t>(f)]].push_back(triangles(f, k));
    found.middles = Vertices::Zero(static_cast<Eigen::Index>(number.size()), 3);
    Eigen::AlignedBox3d box;
    for (std::size_t g = 0; g < found.corners.size(); ++g) {
        std::vector<Index>& own = found.corners[g];
        sort_unique(own);
        for (const Index v : own) {
            found.middles.row(static_cast<Eigen::Index>(g)) += vertices.row(v) / static_cast<double>(own.size());
            box.extend(vertices.row(v).transpose());
        }
    }
    found.diagonal = found.corners.empty() ? 0.0 : box.diagonal().norm();
    return found;
}

/// The polygon at the mirror image of each polygon, or nothing.
std::vector<Index> mirrored_polygons(const PolygonCorners& polygons, const NearestPoint& nearest,
                                     const MirrorPlane& plane)
{
    std::vector<Index> image(polygons.corners.size());
    for (std::size_t g = 0; g < image.size(); ++g) {
        image[g] = nearest.at(plane.image(polygons.middles.row(static_cast<Eigen::Index>(g))));
        if (image[g] < 0) return {};
    }
    for (std::size_t g = 0; g < image.size(); ++g)
        if (image[image[g]] != static_cast<Index>(g)) return {};
    return image;
}

/// For each corner of a polygon its mirror image among the corners of the image; nothing unless all have one.
std::vector<Index> mirrored_corners(const Vertices& vertices, const std::vector<Index>& own,
                                    const std::vector<Index>& there, const MirrorPlane& plane, double reach)
{
    if (own.size() != there.size()) return {};
    std::vector<Index> image;
    for (const Index v : own) {
        const Eigen::RowVector3d place = plane.image(vertices.row(v));
        const auto away = [&](Index w) { return (vertices.row(w) - place).norm(); };
        const Index best = *std::ranges::min_element(there, {}, away);
        if (!(away(best) < reach)) return {};
        image.push_back(best);
    }
    std::vector<Index> sorted = image;
    std::ranges::sort(sorted);
    return sorted == there ? image : std::vector<Index>{};
}

/// Fills in the mirror images. Returns false if the plane is not a mirror.
bool is_mirror(const Vertices& vertices, const PolygonCorners& polygons, const NearestPoint& nearest,
               const MirrorPlane& plane, double reach, Mirror& mirror)
{
    // Polygons go to polygons.
    const std::vector<Index> image = mirrored_polygons(polygons, nearest, plane);
    if (image.empty()) return false;
    std::vector<Index> vertex(static_cast<std::size_t>(vertices.rows()), -1);
    std::size_t corners = 0, fixed = 0;
    bool torn = false;
    // Corners go to corners. Vertices are torn if two polygons give them different images.
    for (std::size_t g = 0; g < image.size(); ++g) {
        const std::vector<Index>& own = polygons.corners[g];
        const std::vector<Index> images = mirrored_corners(vertices, own, polygons.corners[image[g]], plane, reach);
        if (images.empty()) return false;
        for (std::size_t k = 0; k < own.size(); ++k) {
            Index& known = vertex[own[k]];
            torn = torn || (known >= 0 && known != images[k]);
            known = images[k];
            ++corners;
            fixed += images[k] == own[k] ? 1 : 0;
        }
    }
    // A flat mesh is its own image in its plane: that is no symmetry.
    if (static_cast<double>(fixed) > most_in_plane * static_cast<double>(corners)) return false;
    mirror.side.resize(image.size());
    for (std::size_t g = 0; g < image.size(); ++g)
        mirror.side[g] = plane.distance(polygons.middles.row(static_cast<Eigen::Index>(g))) -
                         plane.distance(polygons.middles.row(image[g]));
    mirror.image = image;
    if (!torn) mirror.vertex = std::move(vertex);
    return true;
}

}  // namespace

Mirror find_mirror(const Vertices& vertices, const Triangles& triangles, const std::vector<Index>& polygon)
{
    PolygonCorners polygons = polygon_corners(vertices, triangles, polygon);
    Mirror mirror;
    mirror.group = std::move(polygons.group);
    const double reach = off_mirror * polygons.diagonal;
    if (!(std::isfinite(reach) && reach > 0.0 && polygons.middles.allFinite())) return mirror;
    const NearestPoint nearest(polygons.middles, reach);
    for (const MirrorPlane& plane : possible_mirrors(polygons.middles, VectorXd::Ones(polygons.middles.rows())))
        if (is_mirror(vertices, polygons, nearest, plane, reach, mirror)) break;
    return mirror;
}

}  // namespace koebe
