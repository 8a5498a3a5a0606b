#include "flat/tube_slit.h"

#include "core/connectivity.h"
#include "core/length.h"
#include "cost/costs.h"
#include "mesh/nearest_first.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace koebe {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
constexpr double price_of_turning = 2.0;  // cost of an edge across the strip, over that of an edge along it
constexpr double chosen_share = 1e-4;     // share of an edge's cost where the caller wants the slit

/// The difference of two angles in (-pi, pi].
double turn(double from, double to)
{
    const double d = to - from;
    return d - two_pi * std::round(d / two_pi);
}

bool within_polygon(const PartMesh& mesh, Index h, Index twin)
{
    return !mesh.polygon.empty() && mesh.polygon[face_of(h)] == mesh.polygon[face_of(twin)];
}

/// 1 for the half-edges on the slit, both sides; empty if the loops are not connected.
std::vector<char> slit_edges(const Part& part, double& slit_length)
{
    const Surface& surface = part.mesh.surface;
    const Triangles& triangles = surface.triangles;
    const Index count = surface.vertex_count;
    // Edges along which the tube may be opened.
    std::vector<char> is_end(count, 0);
    std::vector<Index> arrived(count, no_twin);  // half-edge by which a vertex is reached
    std::vector<std::vector<Index>> leaving(count);
    for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h)
        if (const Index t = surface.twin[h]; t != no_twin && !within_polygon(part.mesh, h, t))
            leaving[origin(triangles, h)].push_back(h);
    // The shortest way from one loop to the other. Edges across the strip count as longer, shown ones too.
    NearestFirst nearest(count);
    for (const Index v : surface.loops[1]) is_end[v] = 1;
    for (const Index v : surface.loops[0]) nearest.reach(v, 0.0);
    Index end = nearest.take();
    for (; end >= 0 && !is_end[end]; end = nearest.take()) {
        const Index v = end;
        for (const Index h : leaving[v]) {
            const Index w = target(triangles, h);
            const Complex a = part.map.strip[v], b = part.map.strip[w];
            const double share = !part.mesh.slit.empty() && part.mesh.slit[h] ? chosen_share : 1.0;
            const double along = std::abs(b.real() - a.real()), across = std::abs(turn(a.imag(), b.imag()));
            const double length =
                length_of(part.mesh.vertices.row(w) - part.mesh.vertices.row(v)) * price_of_edge(part.mesh.shown, v, w);
            const double whole = std::hypot(along, across);
            const double crooked = whole > 0.0 ? (along + price_of_turning * across) / whole : 1.0;
            if (nearest.reach(w, nearest.distance()[v] + share * crooked * length)) arrived[w] = h;
        }
    }
    if (end < 0) return {};
    // Back along this way.
    std::vector<char> slit(triangles.size(), 0);
    for (Index v = end; arrived[v] != no_twin; v = origin(triangles, arrived[v])) {
        slit[arrived[v]] = slit[surface.twin[arrived[v]]] = 1;
        slit_length += length_of(part.mesh.vertices.row(v) - part.mesh.vertices.row(origin(triangles, arrived[v])));
    }
    return slit;
}

}  // namespace

TubeSlit tube_slit(const Part& part)
{
    TubeSlit result;
    const Surface& surface = part.mesh.surface;
    const Triangles& triangles = surface.triangles;
    const std::vector<char> slit = slit_edges(part, result.length);
    if (slit.empty()) return result;

    // From face to face over edges off the slit: an edge's ends keep their turns, the third corner is the nearest.
    const Index unset = std::numeric_limits<int>::min();
    std::vector<int> lift(triangles.size(), unset);
    const auto nearest = [&](Index from, Index corner) {
        const double a = part.map.strip[triangles.data()[from]].imag() + two_pi * lift[from];
        return static_cast<int>(std::lround((a - part.map.strip[triangles.data()[corner]].imag()) / two_pi));
    };
    std::vector<Index> queue{0};
    lift[0] = 0;
    lift[1] = nearest(0, 1);
    lift[2] = nearest(0, 2);
    for (std::size_t head = 0; head < queue.size(); ++head)
        for (Index h = 3 * queue[head]; h < 3 * queue[head] + 3; ++h) {
            const Index t = surface.twin[h];
            if (t == no_twin || slit[h]) continue;
            const Index next = next_halfedge(t), third = previous_halfedge(t);
            if (lift[t] == unset) {
                lift[t] = lift[next_halfedge(h)];
                lift[next] = lift[h];
                lift[third] = nearest(t, third);
                queue.push_back(face_of(t));
            } else if (lift[t] != lift[next_halfedge(h)] || lift[next] != lift[h]) {
                return result;  // an edge that spans half a turn: too coarse to tell
            }
        }
    if (queue.size() == static_cast<std::size_t>(triangles.rows())) result.lift = std::move(lift);
    return result;
}

}  // namespace koebe
