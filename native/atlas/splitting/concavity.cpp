#include "splitting/concavity.h"

#include "core/connectivity.h"
#include "surface/face_vectors.h"
#include "surface/local_density.h"

#include <Eigen/Geometry>

#include <cmath>

namespace koebe {

VectorXd mean_curvature(const CutSurface& whole, double radius)
{
    const Triangles& triangles = whole.surface.triangles;
    const Eigen::Index faces = triangles.rows(), vertices = whole.vertices.rows();
    Eigen::MatrixX3d normals(faces, 3);
    for (Eigen::Index f = 0; f < faces; ++f)
        normals.row(f) = twice_area_vector(whole.vertices, triangles, f).normalized();
    const double side = outer_side(whole.vertices, triangles);

    // Half the edge's length times its bend, shared by its ends; over the area of the faces round them.
    VectorXd bend = VectorXd::Zero(vertices), area = bend;
    for (Eigen::Index f = 0; f < faces; ++f)
        for (int k = 0; k < 3; ++k) area[triangles(f, k)] += whole.areas[f] / 3.0;
    for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h) {
        const Index v = origin(triangles, h), w = target(triangles, h), t = whole.surface.twin[h];
        if (t == no_twin || t < h) continue;
        const Eigen::RowVector3d m = normals.row(face_of(h)), n = normals.row(face_of(t));
        const Eigen::RowVector3d along = whole.vertices.row(w) - whole.vertices.row(v);
        const double angle = std::atan2(m.cross(n).norm(), m.dot(n));
        const double bulges = m.cross(n).dot(along) > 0.0 ? side : -side;
        const double share = 0.25 * whole.lengths[h] * bulges * angle;
        bend[v] += share;
        bend[w] += share;
    }

    return local_density(whole.vertices, triangles, bend, area, radius);
}

}  // namespace koebe
