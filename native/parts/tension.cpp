#include "parts/tension.h"

#include "core/complex_places.h"
#include "planar/planar_predicates.h"

#include <numeric>

namespace koebe {
namespace {

/// The last half-edge from the same vertex, counter-clockwise, before the boundary.
Index last_counter_clockwise(const Surface& surface, Index h)
{
    while (surface.twin[previous_halfedge(h)] != no_twin) h = surface.twin[previous_halfedge(h)];
    return h;
}

}  // namespace

SeamedMesh seamed(const Vertices& vertices, const Surface& surface, const std::vector<Index>& polygon,
                  const std::vector<double>& shown)
{
    const Triangles& triangles = surface.triangles;
    SeamedMesh mesh;
    mesh.corners = mesh.fans = triangles;
    mesh.face.resize(static_cast<std::size_t>(triangles.rows()));
    std::iota(mesh.face.begin(), mesh.face.end(), 0);
    mesh.turned.assign(mesh.face.size(), 0);
    mesh.twin = surface.twin;
    mesh.fan_count = surface.vertex_count;
    const Index count = mesh.halfedge_count();
    for (Index h = 0; h < count; ++h) {
        const Index a = origin(triangles, h), b = target(triangles, h), t = mesh.twin[h];
        mesh.length.push_back((vertices.row(a) - vertices.row(b)).norm() * price_of_edge(shown, a, b));
        const bool within = t != no_twin && !polygon.empty() && polygon[face_of(h)] == polygon[face_of(t)];
        mesh.whole.push_back(t == no_twin || within);
    }
    return mesh;
}

SeamedMesh seamed(const FlatPart& flat, const std::vector<double>& shown)
{
    return seamed(flat.vertices, flat.surface, flat.polygon, shown);
}

EvenForces forces_in(const FlatPart& flat, double even)
{
    const Eigen::Map<const VectorXd> sizes(flat.sizes.data(), static_cast<Eigen::Index>(flat.sizes.size()));
    return even_forces(flat.vertices, flat.surface.triangles, flat.points, even, sizes);
}

Tension::Tension(const FlatPart& flat, const EvenForces& forces)
    : flat_(flat), forces_(forces), whole_(VectorXcd::Zero(flat.points.rows())), leaving_(flat.points.rows(), no_twin)
{
    const Triangles& triangles = flat.surface.triangles;
    for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h) {
        whole_[origin(triangles, h)] += forces.pull[face_of(h)][h % 3];
        leaving_[origin(triangles, h)] = h;
    }
}

Complex Tension::at(Index v, Index from, Index to) const
{
    const Complex way = complex_at(flat_.points, from) - complex_at(flat_.points, to >= 0 ? to : v);
    const double length = std::abs(way);
    if (!(length > 0.0)) return 0.0;
    const Complex half = pull_of_left(v, from, to) - 0.5 * whole_[v];
    return half * std::conj(way) / length;
}

/// The force of the faces from the edge to one neighbour, counter-clockwise to another neighbour or the boundary.
Complex Tension::pull_of_left(Index v, Index from, Index to) const
{
    const Triangles& triangles = flat_.surface.triangles;
    Complex sum = 0.0;
    Index h = leaving_[v];
    const Index first = h;
    while (target(triangles, h) != from) {  // clockwise, and from the boundary on from its other end
        const Index t = flat_.surface.twin[h];
        h = t == no_twin ? last_counter_clockwise(flat_.surface, h) : next_halfedge(t);
        if (h == first) return 0.5 * whole_[v];
    }
    while (true) {
        sum += forces_.pull[face_of(h)][h % 3];
        const Index back = previous_halfedge(h);
        if (origin(triangles, back) == to || flat_.surface.twin[back] == no_twin) return sum;
        h = flat_.surface.twin[back];
        if (target(triangles, h) == from) return sum;
    }
}

}  // namespace koebe
