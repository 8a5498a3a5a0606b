#include "lift/solid.h"

#include "core/errors.h"
#include "mesh/connectivity.h"

#include <Eigen/Geometry>

#include <utility>

namespace koebe {
namespace {

Eigen::RowVector3d normal_of(const Vertices& vertices, const Triangles& triangles, Eigen::Index f)
{
    const Eigen::RowVector3d a = vertices.row(triangles(f, 0));
    const Eigen::RowVector3d b = vertices.row(triangles(f, 1)) - a, c = vertices.row(triangles(f, 2)) - a;
    return b.cross(c);
}

Vertices moved(const Vertices& vertices, const Vertices& normals, const VectorXd& by)
{
    return vertices + (normals.array().colwise() * by.array()).matrix();
}

void require_upright(const Vertices& before, const Vertices& after, const Triangles& triangles)
{
    std::vector<Index> turned = overturned_faces(before, after, triangles);
    if (!turned.empty())
        throw InputError("the thickness or height is more than the surface's bends allow: faces would turn over",
                         ElementKind::faces, std::move(turned));
}

}  // namespace

std::vector<Index> overturned_faces(const Vertices& before, const Vertices& after, const Triangles& triangles)
{
    std::vector<Index> faces;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
        const Eigen::RowVector3d old = normal_of(before, triangles, f);
        if (old.squaredNorm() > 0.0 && !(old.dot(normal_of(after, triangles, f)) > 0.0))
            faces.push_back(static_cast<Index>(f));
    }
    return faces;
}

Solid thicken(const Vertices& vertices, const Triangles& triangles, const Vertices& normals, const VectorXd& out,
              const VectorXd& in)
{
    const Index count = static_cast<Index>(vertices.rows()), faces = static_cast<Index>(triangles.rows());
    const Vertices outside = moved(vertices, normals, out), inside = moved(vertices, normals, -in);
    require_upright(vertices, outside, triangles);
    require_upright(vertices, inside, triangles);
    const std::vector<Index> twin = pair_halfedges(triangles, count);
    const Index rim = static_cast<Index>(std::count(twin.begin(), twin.end(), no_twin));

    Solid solid;
    solid.vertices.resize(2 * count, 3);
    solid.vertices << outside, inside;
    solid.triangles.resize(2 * faces + 2 * rim, 3);
    solid.triangles.topRows(faces) = triangles;
    for (Index f = 0; f < faces; ++f)
        solid.triangles.row(faces + f) << count + triangles(f, 0), count + triangles(f, 2), count + triangles(f, 1);
    Index wall = 2 * faces;
    for (Index h = 0; h < 3 * faces; ++h) {
        if (twin[h] != no_twin) continue;
        const Index a = origin(triangles, h), b = target(triangles, h);
        solid.triangles.row(wall++) << b, a, count + a;
        solid.triangles.row(wall++) << b, count + a, count + b;
    }
    solid.patch.assign(faces, 0);
    solid.patch.resize(2 * faces, 1);
    solid.patch.resize(solid.triangles.rows(), 2);
    return solid;
}

}  // namespace koebe
