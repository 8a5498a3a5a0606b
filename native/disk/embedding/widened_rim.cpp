#include "embedding/widened_rim.h"

#include "core/connectivity.h"
#include "mesh/connected_pieces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace koebe {
namespace {

constexpr Index most_vertices = 5000;  // arcs inside arcs take time by the square of their number
constexpr double longest_arc = 2.5;    // radians

/// The part cut off by an edge between two outer vertices: an arc of the loop, and the number of faces behind it.
struct Arc {
    Index first, steps;
    double faces;
};

/// Cuts the faces into parts by edges that join outer vertices. Returns each part's arc, inner ones first, except for
/// the part with the centre, or else the largest part.
std::vector<Arc> arcs_of(const FilledDisk& filled, const VertexLoop& outer, Index center)
{
    const Triangles& triangles = filled.triangles;
    const auto n = static_cast<Index>(outer.size());
    std::vector<Index> place(filled.vertex_count, -1);
    for (Index i = 0; i < n; ++i) place[outer[i]] = i;
    const std::vector<Index> twin = pair_halfedges(triangles, filled.vertex_count);
    const auto chord = [&](Index h) {
        return twin[h] != no_twin && place[origin(triangles, h)] >= 0 && place[target(triangles, h)] >= 0;
    };
    Index count = 0;
    const std::vector<Index> part = joined_pieces(twin, count, [&](Index h) { return !chord(h); });
    std::vector<Index> size(static_cast<std::size_t>(count), 0);
    for (const Index id : part) ++size[id];
    std::vector<std::vector<Index>> chords(size.size());  // half-edges of each part
    for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h)
        if (chord(h)) chords[part[face_of(h)]].push_back(h);
    // The root: the largest part, or the part with the centre.
    auto root = static_cast<Index>(std::max_element(size.begin(), size.end()) - size.begin());
    for (Index h = 0; h < static_cast<Index>(triangles.size()) && center >= 0; ++h)
        if (origin(triangles, h) == center) root = part[face_of(h)];
    struct Entry {
        Index part, door;  // the part's half-edge on the edge towards the root; -1 for the root
    };
    std::vector<Entry> order{{root, -1}};
    std::vector<Index> parent(size.size(), -1);
    for (std::size_t k = 0; k < order.size(); ++k)
        for (const Index h : chords[order[k].part])
            if (h != order[k].door) {
                order.push_back({part[face_of(twin[h])], twin[h]});
                parent[order.back().part] = order[k].part;
            }
    // Each part adds its faces to the part towards the root: an arc counts all faces behind its chord.
    std::vector<double> faces_behind(size.begin(), size.end());
    std::vector<Arc> arcs;
    for (std::size_t k = order.size() - 1; k > 0; --k) {
        const auto [id, door] = order[k];
        // The part is on the left of its door, so the loop runs on from the door's end to its start.
        const Index first = place[target(triangles, door)], last = place[origin(triangles, door)];
        arcs.push_back({first, (last - first + n) % n, faces_behind[id]});
        faces_behind[parent[id]] += faces_behind[id];
    }
    return arcs;
}

}  // namespace

VectorXcd widened_rim(const FilledDisk& filled, const VertexLoop& outer, const VectorXcd& rim, double share,
                      Index center)
{
    const auto n = static_cast<Index>(outer.size());
    VectorXd steps = VectorXd::Constant(n, 2.0 * std::numbers::pi / n);
    // Give an arc with many faces behind it the angle a at which its cap's share of the disk, about a^3 / 12 pi, is
    // theirs.
    if (n <= most_vertices)
        for (const Arc& arc : arcs_of(filled, outer, center)) {
            const double share_of_faces = arc.faces / static_cast<double>(filled.triangles.rows());
            const double needed = std::min(std::cbrt(12.0 * std::numbers::pi * share_of_faces), longest_arc);
            double now = 0.0;
            for (Index i = 0; i < arc.steps; ++i) now += steps[(arc.first + i) % n];
            if (now < needed)
                for (Index i = 0; i < arc.steps; ++i) steps[(arc.first + i) % n] *= needed / now;
        }
    // No arc of the given rim becomes shorter.
    for (Index i = 0; i < n; ++i) {
        const double given = std::arg(rim[(i + 1) % n] / rim[i]);
        const double angle = given > 0.0 ? given : given + 2.0 * std::numbers::pi;
        steps[i] = share < 1.0 ? std::max(angle, share * steps[i]) : steps[i];
    }
    // Close the circle.
    steps *= 2.0 * std::numbers::pi / steps.sum();
    VectorXcd result(n);
    double angle = std::arg(rim[0]);
    for (Index i = 0; i < n; ++i) {
        result[i] = std::polar(1.0, angle);
        angle += steps[i];
    }
    return result;
}

}  // namespace koebe
