#include "flatten/stretch.h"

#include "part_maps/part_mesh.h"

#include <Eigen/Geometry>

#include <cmath>

namespace koebe {
namespace {

void add_stretch(const FlatPart& part, StretchSum& sum)
{
    const VectorXd areas = face_areas(part.vertices, part.surface.triangles);
    for (Eigen::Index f = 0; f < areas.size(); ++f) {
        const FlatTriangle flat = laid_flat(part.vertices, part.surface.triangles.row(f));
        Eigen::Matrix<double, 3, 2> corners;
        for (int k = 0; k < 3; ++k) corners.row(k) = part.points.row(part.surface.triangles(f, k));
        if (flat.has_angles()) sum.add(areas[f], stretch_of(flat, corners));
    }
}

}  // namespace

FlatTriangle laid_flat(const Vertices& vertices, const Eigen::RowVector3i& face)
{
    const Eigen::RowVector3d a = vertices.row(face[1]) - vertices.row(face[0]);
    const Eigen::RowVector3d b = vertices.row(face[2]) - vertices.row(face[0]);
    const double length = a.norm();
    return {length, a.dot(b) / length, a.cross(b).norm() / length};
}

double stretch_of(const FlatTriangle& flat, const Eigen::Matrix<double, 3, 2>& corners)
{
    const Eigen::RowVector2d a = (corners.row(1) - corners.row(0)) / flat.p1x;
    const Eigen::RowVector2d b = (corners.row(2) - corners.row(0) - flat.p2x * a) / flat.p2y;
    const double same = std::hypot(a[0] + b[1], a[1] - b[0]), mirrored = std::hypot(a[0] - b[1], a[1] + b[0]);
    return std::max(0.5 * (same + mirrored) - 1.0, 1.0 - 0.5 * (same - mirrored));
}

double mean_stretch(const FlatPart& part)
{
    StretchSum sum;
    add_stretch(part, sum);
    return 0.01 * sum.result().mean;
}

}  // namespace koebe
