#include "foldover/patch_shapes.h"

#include "surface/laplacian.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace koebe {
namespace {

constexpr double least_height = 1e-2;  // of a wanted shape, over its longest edge
constexpr double least_size = 1e-14;   // of a wanted shape, disk units

/// Columns: edges 0-1 and 0-2 of a face with these edge lengths, scaled to an area.
Eigen::Matrix2d shaped(double l01, double l12, double l20, double area)
{
    const double longest = std::max({l01, l12, l20});
    Eigen::Matrix2d edges;
    if (!(longest > 0.0)) return shaped(1.0, 1.0, 1.0, area);
    l01 = std::max(l01, least_height * longest);
    const double height = std::max(2.0 * triangle_area(l01, l12, l20), least_height * longest * longest) / l01;
    edges << l01, (l01 * l01 + l20 * l20 - l12 * l12) / (2.0 * l01), 0.0, height;
    return edges * std::sqrt(2.0 * area / edges.determinant());
}

/// The corners of some faces, (n, 3), with vertices numbered from 0 in the order they appear.
Triangles numbered_corners(const Triangles& triangles, const std::vector<Index>& faces)
{
    std::unordered_map<Index, Index> number_of;
    number_of.reserve(faces.size());
    Triangles corners(faces.size(), 3);
    for (std::size_t i = 0; i < faces.size(); ++i)
        for (int k = 0; k < 3; ++k)
            corners(i, k) =
                number_of.emplace(triangles(faces[i], k), static_cast<Index>(number_of.size())).first->second;
    return corners;
}

VectorXd wanted_areas(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& uv,
                      const std::vector<Index>& faces, PatchShape shape)
{
    struct Sums {
        double planar = 0.0, surface = 0.0, area = 0.0, count = 0.0;
    };
    const Triangles corners = numbered_corners(triangles, faces);
    std::vector<Sums> around(corners.size());
    VectorXd areas(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const Index a = triangles(faces[i], k), b = triangles(faces[i], (k + 1) % 3);
            const double planar = (uv.row(a) - uv.row(b)).squaredNorm();
            const double spatial = (vertices.row(a) - vertices.row(b)).squaredNorm();
            for (const Index corner : {corners(i, k), corners(i, (k + 1) % 3)}) {
                around[corner].planar += planar;
                around[corner].surface += spatial;
            }
        }
    // The local scale at a corner: squared lengths in the map over those on the surface, of the edges around it. A
    // face takes the geometric mean of its corners.
    const auto corner_mean = [&](std::size_t i, auto value) {
        double log_sum = 0.0;
        for (const Index corner : corners.row(i)) log_sum += std::log(std::max(value(around[corner]), 1e-300));
        return std::exp(log_sum / 3.0);
    };
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const Index f = faces[i];
        const Eigen::RowVector3d p = vertices.row(triangles(f, 0));
        const double l0 = (vertices.row(triangles(f, 1)) - p).norm();
        const double l1 = (vertices.row(triangles(f, 2)) - vertices.row(triangles(f, 1))).norm();
        const double l2 = (vertices.row(triangles(f, 2)) - p).norm();
        double factor = 1.0;
        if (shape != PatchShape::true_size)
            factor = corner_mean(i, [](const Sums& s) { return s.planar / std::max(s.surface, 1e-300); });
        // At least a thin triangle's area, so that needles keep a size.
        const double longest = std::max({l0, l1, l2});
        areas[i] = factor * std::max(triangle_area(l0, l1, l2), 0.5 * least_height * longest * longest);
        areas[i] = std::max(areas[i], least_size * least_size);
        for (const Index corner : corners.row(i)) {
            around[corner].area += areas[i];
            around[corner].count += 1.0;
        }
    }
    // Equilateral triangles have the mean area around their corners.
    if (shape == PatchShape::equilateral)
        for (std::size_t i = 0; i < faces.size(); ++i)
            areas[i] = corner_mean(i, [](const Sums& s) { return s.area / s.count; });
    return areas;
}

}  // namespace

PatchShapes patch_shapes(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& uv,
                         const std::vector<Index>& faces, PatchShape shape)
{
    PatchShapes result;
    result.areas = wanted_areas(vertices, triangles, uv, faces, shape);
    for (std::size_t i = 0; i < faces.size(); ++i) {
        double lengths[3] = {1.0, 1.0, 1.0};
        for (int k = 0; k < 3 && shape != PatchShape::equilateral; ++k)
            lengths[k] = (vertices.row(triangles(faces[i], k)) - vertices.row(triangles(faces[i], (k + 1) % 3))).norm();
        result.references.push_back(shaped(lengths[0], lengths[1], lengths[2], result.areas[i]));
    }
    return result;
}

}  // namespace koebe
