// Meshes for the writers: nothing about them is a surface.
#pragma once

#include "io/polygon_mesh.h"

#include <cmath>
#include <random>

namespace koebe::test {

/// Polygons over random vertices of all magnitudes.
inline PolygonMesh random_polygons(Index vertex_count, Index face_count)
{
    std::mt19937_64 random(3);
    PolygonMesh mesh;
    mesh.vertices.resize(vertex_count, 3);
    for (double& x : mesh.vertices.reshaped())
        x = std::uniform_real_distribution<double>(-1.0, 1.0)(random) *
            std::pow(10.0, static_cast<int>(random() % 600) - 300);
    for (Index f = 0; f < face_count; ++f) {
        for (Index corner = 0; corner < 3 + f % 4; ++corner)
            mesh.corners.push_back(static_cast<Index>(random() % vertex_count));
        mesh.face_begin.push_back(static_cast<Index>(mesh.corners.size()));
    }
    return mesh;
}

/// 400 points, some beyond the unit circle by rounding.
inline PlanarPoints points_of_the_disk()
{
    PlanarPoints points = PlanarPoints::Random(400, 2) * 0.7;
    points.topRows(3) << 1.0 + 1e-12, 0.0, 0.0, -1.0 - 1e-12, 1.0 / 3.0, -1.0 / 7.0;
    return points;
}

}  // namespace koebe::test
