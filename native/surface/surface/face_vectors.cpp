#include "surface/face_vectors.h"

#include <Eigen/Geometry>

#include <cmath>

namespace koebe {

VectorXd angle_sums(const Vertices& vertices, const Triangles& triangles)
{
    VectorXd sums = VectorXd::Zero(vertices.rows());
    for (const auto face : triangles.rowwise())
        for (int k = 0; k < 3; ++k) {
            const Eigen::RowVector3d a = vertices.row(face[(k + 1) % 3]) - vertices.row(face[k]);
            const Eigen::RowVector3d b = vertices.row(face[(k + 2) % 3]) - vertices.row(face[k]);
            sums[face[k]] += std::atan2(a.cross(b).norm(), a.dot(b));
        }
    return sums;
}

double outer_side(const Vertices& vertices, const Triangles& triangles)
{
    const Eigen::RowVector3d center = vertices.colwise().mean();
    double outward = 0.0;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        Eigen::RowVector3d corners = Eigen::RowVector3d::Zero();
        for (const Index v : triangles.row(f)) corners += vertices.row(v);
        outward += twice_area_vector(vertices, triangles, f).dot(corners / 3.0 - center);
    }
    return outward < 0.0 ? -1.0 : 1.0;
}

}  // namespace koebe
