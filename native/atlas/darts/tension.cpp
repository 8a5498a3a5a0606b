#include "darts/tension.h"

#include "core/complex_places.h"
#include "core/numbering.h"
#include "cost/costs.h"
#include "even/even_map.h"
#include "planar/planar_predicates.h"

#include <algorithm>
#include <cstddef>

namespace koebe {
namespace {

VectorXd sizes_of(const FlatPart& flat)
{
    return Eigen::Map<const VectorXd>(flat.sizes.data(), static_cast<Eigen::Index>(flat.sizes.size()));
}

}  // namespace
SeamedMesh seamed(const Vertices& vertices, const Surface& surface, const std::vector<Index>& polygon,
                  const std::vector<double>& shown)
{
    const Triangles& triangles = surface.triangles;
    SeamedMesh mesh;
    mesh.corners = mesh.fans = triangles;
    mesh.face = numbers_below(triangles.rows());
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

VectorXd weights_of_faces(const FlatPart& flat)
{
    if (flat.shown.empty()) return {};
    VectorXd weights(flat.surface.triangles.rows());
    for (Index f = 0; f < static_cast<Index>(weights.size()); ++f) {
        double shown = 0.0;
        for (const Index v : flat.surface.triangles.row(f)) shown += flat.shown[v] / 3.0;
        weights[f] = weight_of_face(shown);
    }
    return weights;
}

EvenForces forces_in(const FlatPart& flat, double even)
{
    EvenForces forces = even_forces(flat.vertices, flat.surface.triangles, flat.points, even, sizes_of(flat));
    const VectorXd weights = weights_of_faces(flat);
    for (Index f = 0; f < static_cast<Index>(weights.size()); ++f) {
        forces.energy[f] *= weights[f];
        for (Complex& pull : forces.pull[f]) pull *= weights[f];
    }
    return forces;
}

std::vector<int> strained_faces(const VectorXd& energy, const VectorXd& areas)
{
    std::vector<int> strained(static_cast<std::size_t>(areas.size()));
    for (Eigen::Index f = 0; f < areas.size(); ++f) strained[f] = energy[f] > tuning::strained * areas[f] ? 1 : 0;
    return strained;
}

bool is_true_to_size(const FlatPart& flat)
{
    return is_true_to_size(flat.vertices, flat.surface.triangles, flat.points, sizes_of(flat));
}

Tension::Tension(const FlatPart& flat, const EvenForces& forces) : flat_(flat), begin_{0}
{
    const Surface& surface = flat.surface;
    std::vector<Index> leaving(static_cast<std::size_t>(flat.points.rows()), no_twin);
    for (Index h = 0; h < static_cast<Index>(surface.triangles.size()); ++h)
        // On the boundary the ring starts at the half-edge that has no face on its right.
        if (Index& own = leaving[origin(surface.triangles, h)]; own == no_twin || surface.twin[h] == no_twin) own = h;
    for (std::size_t v = 0; v < leaving.size(); ++v) add_ring(static_cast<Index>(v), leaving[v], forces);
}

void Tension::add_ring(Index v, Index leaving, const EvenForces& forces)
{
    const Surface& surface = flat_.surface;
    const auto add = [&](Index neighbour, Complex sum) {
        neighbours_.push_back({neighbour, static_cast<Index>(neighbours_.size() - begin_[v])});
        sums_.push_back(sum);
    };
    Complex sum = 0.0;
    for (Index h = leaving; h != no_twin;) {
        add(target(surface.triangles, h), sum);
        sum += forces.pull[face_of(h)][h % 3];
        const Index back = previous_halfedge(h);
        h = surface.twin[back];
        if (h == no_twin || h == leaving) add(origin(surface.triangles, back), sum);
        if (h == leaving) break;
    }
    if (leaving == no_twin) add(-1, sum);
    std::ranges::stable_sort(neighbours_.begin() + static_cast<std::ptrdiff_t>(begin_[v]), neighbours_.end(), {},
                             &Neighbour::vertex);
    begin_.push_back(neighbours_.size());
}

Complex Tension::at(Index v, Index from, Index to) const
{
    const Complex way = complex_at(flat_.points, from) - complex_at(flat_.points, to >= 0 ? to : v);
    const double length = std::abs(way);
    if (!(length > 0.0)) return 0.0;
    const Complex half = pull_of_left(v, from, to) - 0.5 * whole(v);
    return half * std::conj(way) / length;
}

/// The first place of a neighbour in the ring of a vertex; -1 if it is none.
Index Tension::place_of(Index v, Index neighbour) const
{
    const auto end = neighbours_.begin() + static_cast<std::ptrdiff_t>(begin_[v + 1]);
    const auto found = std::ranges::lower_bound(neighbours_.begin() + static_cast<std::ptrdiff_t>(begin_[v]), end,
                                                neighbour, {}, &Neighbour::vertex);
    return found != end && found->vertex == neighbour ? found->place : -1;
}

/// The force of the faces from the edge to one neighbour, counter-clockwise to another neighbour or the boundary.
Complex Tension::pull_of_left(Index v, Index from, Index to) const
{
    const auto before = [&](Index place) { return sums_[begin_[v] + static_cast<std::size_t>(place)]; };
    const Index first = place_of(v, from), last = place_of(v, to);
    if (first < 0) return 0.5 * whole(v);
    if (last >= 0 && last <= first) return whole(v) - before(first) + before(last);
    return (last < 0 ? whole(v) : before(last)) - before(first);
}

}  // namespace koebe
