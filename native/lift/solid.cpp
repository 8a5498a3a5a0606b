#include "lift/solid.h"

#include "core/errors.h"
#include "mesh/connectivity.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>

namespace koebe {
namespace {

Eigen::RowVector3d face_normal(const Vertices& vertices, const Triangles& triangles, Eigen::Index f)
{
    const Eigen::RowVector3d a = vertices.row(triangles(f, 0));
    const Eigen::RowVector3d b = vertices.row(triangles(f, 1)) - a, c = vertices.row(triangles(f, 2)) - a;
    return b.cross(c);
}

}  // namespace

Vertices moved_along(const Vertices& vertices, const Vertices& normals, const VectorXd& by, const Triangles& triangles)
{
    Vertices moved = vertices + (normals.array().colwise() * by.array()).matrix();
    std::vector<Index> turned;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const Eigen::RowVector3d before = face_normal(vertices, triangles, f);
        if (before.squaredNorm() > 0.0 && !(before.dot(face_normal(moved, triangles, f)) > 0.0))
            turned.push_back(static_cast<Index>(f));
    }
    if (!turned.empty())
        throw InputError("the thickness or height is more than the surface's bends allow: faces would turn over",
                         ElementKind::faces, std::move(turned));
    return moved;
}

Solid closed_solid(const Vertices& outside, const Triangles& outer_faces, const Vertices& inside,
                   const Triangles& inner_faces)
{
    const Index count = static_cast<Index>(outside.rows()), outer = static_cast<Index>(outer_faces.rows());
    const Index inner = static_cast<Index>(inner_faces.rows());
    const std::vector<Index> twin = pair_halfedges(inner_faces, static_cast<Index>(inside.rows()));
    const Index rim = static_cast<Index>(std::ranges::count(twin, no_twin));

    Solid solid;
    solid.vertices.resize(count + inside.rows(), 3);
    solid.vertices << outside, inside;
    solid.triangles.resize(outer + inner + 2 * rim, 3);
    solid.triangles.topRows(outer) = outer_faces;
    for (Index f = 0; f < inner; ++f)
        solid.triangles.row(outer + f) << count + inner_faces(f, 0), count + inner_faces(f, 2),
            count + inner_faces(f, 1);
    Index wall = outer + inner;
    for (Index h = 0; h < 3 * inner; ++h) {
        if (twin[h] != no_twin) continue;
        const Index a = origin(inner_faces, h), b = target(inner_faces, h);
        solid.triangles.row(wall++) << b, a, count + a;
        solid.triangles.row(wall++) << b, count + a, count + b;
    }
    solid.patch.assign(outer, 0);
    solid.patch.resize(outer + inner, 1);
    solid.patch.resize(solid.triangles.rows(), 2);
    return solid;
}

}  // namespace koebe
