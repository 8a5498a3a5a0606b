#include "splitting/concavity.h"

#include "core/connectivity.h"
#include "surface/face_vectors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace koebe {
namespace {

constexpr double most_diffusion_rounds = 200;  // on meshes far finer than the radius

}  // namespace

VectorXd mean_curvature(const CutSurface& whole, double radius)
{
    const Triangles& triangles = whole.surface.triangles;
    const Eigen::Index faces = triangles.rows(), vertices = whole.vertices.rows();
    Eigen::MatrixX3d normals(faces, 3);
    for (Eigen::Index f = 0; f < faces; ++f)
        normals.row(f) = twice_area_vector(whole.vertices, triangles, f).normalized();
    const double side = outer_side(whole.vertices, triangles);

    // Half the edge's length times its bend, shared by its ends; over the area of the faces round them.
    VectorXd bend = VectorXd::Zero(vertices), area = bend, length = bend, count = bend;
    for (Eigen::Index f = 0; f < faces; ++f)
        for (int k = 0; k < 3; ++k) area[triangles(f, k)] += whole.areas[f] / 3.0;
    for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h) {
        const Index v = origin(triangles, h), w = target(triangles, h), t = whole.surface.twin[h];
        length[v] += whole.lengths[h];
        count[v] += 1.0;
        if (t == no_twin || t < h) continue;
        const Eigen::RowVector3d m = normals.row(face_of(h)), n = normals.row(face_of(t));
        const Eigen::RowVector3d along = whole.vertices.row(w) - whole.vertices.row(v);
        const double angle = std::atan2(m.cross(n).norm(), m.dot(n));
        const double bulges = m.cross(n).dot(along) > 0.0 ? side : -side;
        const double share = 0.25 * whole.lengths[h] * bulges * angle;
        bend[v] += share;
        bend[w] += share;
    }

    // Averages both over rounds of neighbours: so many that they reach about as far as the radius.
    const double step = length.sum() / std::max(count.sum(), 1.0);
    const int rounds = static_cast<int>(
        std::clamp(std::ceil(std::pow(radius / std::max(step, 1e-12), 2)), 1.0, most_diffusion_rounds));
    for (int round = 0; round < rounds; ++round) {
        VectorXd next_bend = bend, next_area = area, degree = VectorXd::Ones(vertices);
        for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h) {
            const Index v = origin(triangles, h), w = target(triangles, h);
            next_bend[v] += bend[w];
            next_area[v] += area[w];
            degree[v] += 1.0;
        }
        bend = next_bend.cwiseQuotient(degree);
        area = next_area.cwiseQuotient(degree);
    }
    return bend.array() / area.array().max(1e-300);
}

}  // namespace koebe
