// Surfaces to be cut into parts: bodies of revolution, a torus, a figure with two arms.
#pragma once

#include "core/types.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace koebe::test {

struct Mesh {
    Vertices vertices;
    Triangles triangles;
};

using std::numbers::pi;

/// A surface of revolution: rings of vertices at (radius, height), each pair of neighbours joined; a point closes an
/// end of radius 0.
inline Mesh revolved(const std::vector<std::pair<double, double>>& profile, int around)
{
    std::vector<Eigen::RowVector3d> points;
    std::vector<std::vector<Index>> rings;
    for (const auto& [radius, height] : profile) {
        std::vector<Index> ring;
        for (int i = 0; i < (radius > 0.0 ? around : 1); ++i) {
            const double angle = 2.0 * pi * i / around;
            ring.push_back(static_cast<Index>(points.size()));
            points.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height);
        }
        rings.push_back(std::move(ring));
    }
    std::vector<Eigen::RowVector3i> faces;
    for (std::size_t r = 0; r + 1 < rings.size(); ++r)
        for (int i = 0; i < around; ++i) {
            const auto at = [&](std::size_t ring, int k) {
                return rings[ring][rings[ring].size() > 1 ? k % around : 0];
            };
            const Index a = at(r, i), b = at(r, i + 1), c = at(r + 1, i), d = at(r + 1, i + 1);
            if (a != b) faces.emplace_back(a, b, c == d ? c : d);
            if (c != d) faces.emplace_back(a, d, c);
        }
    Mesh mesh{Vertices(points.size(), 3), Triangles(faces.size(), 3)};
    for (std::size_t v = 0; v < points.size(); ++v) mesh.vertices.row(v) = points[v];
    for (std::size_t f = 0; f < faces.size(); ++f) mesh.triangles.row(f) = faces[f];
    return mesh;
}

/// A finger: a tube of radius 1, open below, with half a sphere on top.
inline Mesh finger(double length = 10.0, int around = 24)
{
    std::vector<std::pair<double, double>> profile;
    const double step = 2.0 * pi / around;
    for (double h = 0.0; h < length; h += step) profile.emplace_back(1.0, h);
    const int rings = around / 4;
    for (int k = 0; k < rings; ++k)
        profile.emplace_back(std::cos(0.5 * pi * k / rings), length + std::sin(0.5 * pi * k / rings));
    profile.emplace_back(0.0, length + 1.0);
    return revolved(profile, around);
}

/// A flat ring of radii 1/4 and 1.
inline Mesh flat_ring()
{
    std::vector<std::pair<double, double>> profile;
    for (int k = 0; k <= 10; ++k) profile.emplace_back(1.0 - 0.075 * k, 0.0);
    return revolved(profile, 48);
}

/// @param radius of the circle of the tube's middle; the tube's own is 1
inline Mesh torus(int n = 40, int m = 20, double radius = 2.0)
{
    Mesh mesh{Vertices(n * m, 3), Triangles(2 * n * m, 3)};
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j) {
            const double a = 2.0 * pi * i / n, b = 2.0 * pi * j / m, r = radius + std::cos(b);
            mesh.vertices.row(i * m + j) << r * std::cos(a), r * std::sin(a), std::sin(b);
            const Index p = i * m + j, q = (i + 1) % n * m + j, s = i * m + (j + 1) % m,
                        t = (i + 1) % n * m + (j + 1) % m;
            mesh.triangles.row(2 * p) << p, q, t;
            mesh.triangles.row(2 * p + 1) << p, t, s;
        }
    return mesh;
}

/// A trunk with two arms, open at its neck: a grid of squares on boxes, each vertex rounded a little. Mirrored exactly:
/// the half x > 0 is made, and its image with the faces in another order.
inline Mesh figure()
{
    // Voxels of the right half: the trunk, 3 wide of 6, and an arm that leaves it sideways.
    const auto solid = [](int x, int y, int z) {
        x = x < 0 ? -1 - x : x;
        const bool trunk = x < 3 && y >= 0 && y < 5 && z >= 0 && z < 12;
        const bool arm = x >= 3 && x < 22 && y >= 1 && y < 4 && z >= 8 && z < 11;
        return trunk || arm;
    };
    std::map<std::array<int, 3>, Index> number;
    std::vector<std::array<int, 3>> places;
    std::vector<std::array<Index, 4>> quads;
    const auto vertex = [&](int x, int y, int z) {
        const auto [it, isnew] = number.try_emplace({x, y, z}, static_cast<Index>(places.size()));
        if (isnew) places.push_back({x, y, z});
        return it->second;
    };
    for (int x = -22; x < 22; ++x)
        for (int y = 0; y < 5; ++y)
            for (int z = 0; z < 12; ++z) {
                if (!solid(x, y, z)) continue;
                if (!solid(x + 1, y, z))
                    quads.push_back({vertex(x + 1, y, z), vertex(x + 1, y + 1, z), vertex(x + 1, y + 1, z + 1),
                                     vertex(x + 1, y, z + 1)});
                if (!solid(x - 1, y, z))
                    quads.push_back(
                        {vertex(x, y, z), vertex(x, y, z + 1), vertex(x, y + 1, z + 1), vertex(x, y + 1, z)});
                if (!solid(x, y + 1, z))
                    quads.push_back({vertex(x, y + 1, z), vertex(x, y + 1, z + 1), vertex(x + 1, y + 1, z + 1),
                                     vertex(x + 1, y + 1, z)});
                if (!solid(x, y - 1, z))
                    quads.push_back(
                        {vertex(x, y, z), vertex(x + 1, y, z), vertex(x + 1, y, z + 1), vertex(x, y, z + 1)});
                if (!solid(x, y, z + 1) && z + 1 < 12)  // the neck is open
                    quads.push_back({vertex(x, y, z + 1), vertex(x + 1, y, z + 1), vertex(x + 1, y + 1, z + 1),
                                     vertex(x, y + 1, z + 1)});
                if (!solid(x, y, z - 1))
                    quads.push_back(
                        {vertex(x, y, z), vertex(x, y + 1, z), vertex(x + 1, y + 1, z), vertex(x + 1, y, z)});
            }
    Mesh mesh{Vertices(places.size(), 3), Triangles(2 * quads.size(), 3)};
    for (std::size_t v = 0; v < places.size(); ++v) {
        const auto [x, y, z] = places[v];
        const double wide = 1.0 + 0.15 * std::sin(0.7 * std::abs(x) + 0.4 * z);  // of both sides alike
        mesh.vertices.row(v) << x, 2.5 + (y - 2.5) * wide, z + 0.1 * std::sin(0.9 * y);
    }
    for (std::size_t q = 0; q < quads.size(); ++q) {  // the same diagonal on both sides: not mirrored
        const auto& c = quads[q];
        mesh.triangles.row(2 * q) << c[0], c[1], c[2];
        mesh.triangles.row(2 * q + 1) << c[0], c[2], c[3];
    }
    return mesh;
}

}  // namespace koebe::test
