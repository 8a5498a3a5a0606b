#include "lift/solid.h"

#include "core/connectivity.h"
#include "core/errors.h"

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
                   const Triangles& inner_faces, const std::vector<Index>& source)
{
    const Index count = static_cast<Index>(outside.rows()), outer = static_cast<Index>(outer_faces.rows());
    const Index inner = static_cast<Index>(inner_faces.rows());
    const std::vector<Index> twin = pair_halfedges(outer_faces, count);
    std::vector<Index> walls;  // corners
    for (Index h = 0; h < 3 * outer; ++h) {
        if (twin[h] != no_twin) continue;
        const Index a = origin(outer_faces, h), b = target(outer_faces, h);
        walls.insert(walls.end(), {b, a, count + source[a]});
        if (source[a] != source[b]) walls.insert(walls.end(), {b, count + source[a], count + source[b]});
    }

    Solid solid;
    solid.vertices.resize(count + inside.rows(), 3);
    solid.vertices << outside, inside;
    solid.triangles.resize(outer + inner + static_cast<Eigen::Index>(walls.size() / 3), 3);
    solid.triangles.topRows(outer) = outer_faces;
    for (Index f = 0; f < inner; ++f)
        solid.triangles.row(outer + f) << count + inner_faces(f, 0), count + inner_faces(f, 2),
            count + inner_faces(f, 1);
    const Eigen::Index wall_count = static_cast<Eigen::Index>(walls.size() / 3);
    solid.triangles.bottomRows(wall_count) = Eigen::Map<const Triangles>(walls.data(), wall_count, 3);
    solid.patch.assign(outer, 0);
    solid.patch.resize(outer + inner, 1);
    solid.patch.resize(solid.triangles.rows(), 2);
    return solid;
}

}  // namespace koebe
