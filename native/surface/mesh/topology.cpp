#include "mesh/topology.h"

#include "core/connectivity.h"
#include "core/errors.h"
#include "core/prefetch.h"
#include "execution/thread_share.h"

#include <algorithm>
#include <string>
#include <utility>

namespace koebe {
namespace {

bool same_direction(const Triangles& triangles, Index h, Index twin)
{
    return origin(triangles, h) == origin(triangles, twin);
}

struct Orientation {
    std::vector<char> reversed;    // per face, relative to its component's seed
    std::vector<Index> component;  // per face
    Index component_count = 0;
};

/// Whether the first face's component holds all faces.
bool is_connected(const std::vector<Index>& twin)
{
    std::vector<bool> is_met(twin.size() / 3, false);
    std::vector<Index> queue{0};
    queue.reserve(is_met.size());
    is_met[0] = true;
    for (std::size_t head = 0; head < queue.size(); ++head) {
        if (head + steps_ahead < queue.size()) prefetch(&twin[3 * queue[head + steps_ahead]]);
        for (Index h = 3 * queue[head]; h < 3 * queue[head] + 3; ++h)
            if (twin[h] != no_twin && !is_met[face_of(twin[h])]) {
                is_met[face_of(twin[h])] = true;
                queue.push_back(face_of(twin[h]));
            }
    }
    return queue.size() == is_met.size();
}

/// Whether the mesh is connected and all faces have one orientation, as in nearly all meshes.
bool is_in_order(const Triangles& triangles, const std::vector<Index>& twin)
{
    return found_in_pieces(static_cast<Index>(twin.size()),
                           [&](Index h) { return twin[h] > h && same_direction(triangles, h, twin[h]); })
               .empty() &&
           is_connected(twin);
}

/// Walks over each component and makes neighbours agree (breadth first).
Orientation orient_faces(const Triangles& triangles, const std::vector<Index>& twin)
{
    const Index face_count = static_cast<Index>(triangles.rows());
    Orientation result{std::vector<char>(face_count, 0), std::vector<Index>(face_count, -1), 0};
    std::vector<Index> queue;
    for (Index seed = 0; seed < face_count; ++seed) {
        if (result.component[seed] >= 0) continue;
        const Index component = result.component_count++;
        result.component[seed] = component;
        queue.assign(1, seed);
        for (std::size_t head = 0; head < queue.size(); ++head) {
            const Index f = queue[head];
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                if (twin[h] == no_twin) continue;
                const Index g = face_of(twin[h]);
                // Neighbours agree if they run along their edge in different directions.
                const char wanted =
                    static_cast<char>(result.reversed[f] ^ (same_direction(triangles, h, twin[h]) ? 1 : 0));
                if (result.component[g] < 0) {
                    result.component[g] = component;
                    result.reversed[g] = wanted;
                    queue.push_back(g);
                } else if (result.reversed[g] != wanted) {
                    // Reached twice, and both ways round.
                    throw TopologyError(TopologyKind::nonorientable,
                                        "the surface has one side only (a Moebius band runs through the edge listed)",
                                        {origin(triangles, h), target(triangles, h)});
                }
            }
        }
    }
    return result;
}

void require_one_component(const Orientation& orientation)
{
    if (orientation.component_count == 1) return;
    std::vector<Index> size(orientation.component_count, 0);
    for (const Index c : orientation.component) ++size[c];
    const auto largest = std::max_element(size.begin(), size.end()) - size.begin();
    std::vector<Index> outside;
    for (std::size_t f = 0; f < orientation.component.size(); ++f)
        if (orientation.component[f] != largest) outside.push_back(static_cast<Index>(f));
    throw TopologyError(TopologyKind::disconnected,
                        std::to_string(orientation.component_count) +
                            " separate parts (faces outside the largest one listed)",
                        outside);
}

/// Reverses the minority of the faces, and renumbers the half-edges that this moves.
void apply_orientation(Surface& surface, std::vector<char> reversed)
{
    const auto reversed_count = std::count(reversed.begin(), reversed.end(), char{1});
    if (2 * reversed_count > static_cast<std::ptrdiff_t>(reversed.size()))
        for (char& r : reversed) r ^= 1;
    for (std::size_t f = 0; f < reversed.size(); ++f)
        if (reversed[f]) {
            std::swap(surface.triangles(f, 1), surface.triangles(f, 2));
            surface.reoriented.push_back(static_cast<Index>(f));
        }
    if (!surface.reoriented.empty()) surface.twin = pair_halfedges(surface.triangles, surface.vertex_count);
}

/// Every vertex must carry one fan of faces: walk round it once and compare with its number of faces.
void require_manifold_vertices(const Surface& surface)
{
    const Index vertex_count = surface.vertex_count;
    std::vector<Index> face_count(vertex_count, 0);
    std::vector<Index> outgoing(vertex_count, no_twin);
    in_ranges(static_cast<std::size_t>(vertex_count), [&](std::size_t begin, std::size_t end) {
        for (Index h = 0; h < static_cast<Index>(surface.triangles.size()); ++h) {
            const Index v = origin(surface.triangles, h);
            if (v < static_cast<Index>(begin) || v >= static_cast<Index>(end)) continue;
            ++face_count[v];
            // A clockwise walk from a boundary half-edge meets the whole fan.
            if (outgoing[v] == no_twin || surface.twin[h] == no_twin) outgoing[v] = h;
        }
    });
    const std::vector<Index> bad = found_in_pieces(vertex_count, [&](Index v) {
        if (face_count[v] == 0) return false;
        Index met = 0;
        Index h = outgoing[v];
        do {
            ++met;
            h = surface.twin[previous_halfedge(h)];
        } while (h != no_twin && h != outgoing[v]);
        return met != face_count[v];
    });
    if (!bad.empty())
        throw TopologyError(TopologyKind::nonmanifold_vertex,
                            std::to_string(bad.size()) + " vertices join separate fans of faces (vertices listed)",
                            bad);
}

/// @param rim the half-edges without a twin
std::vector<VertexLoop> find_loops(const Surface& surface, const std::vector<Index>& rim)
{
    std::vector<Index> successor(surface.vertex_count, -1);
    for (const Index h : rim) successor[origin(surface.triangles, h)] = target(surface.triangles, h);
    std::vector<VertexLoop> loops;
    for (Index start = 0; start < surface.vertex_count; ++start) {
        if (successor[start] < 0) continue;
        VertexLoop loop;
        for (Index v = start; successor[v] >= 0;) {
            loop.push_back(v);
            v = std::exchange(successor[v], -1);
        }
        loops.push_back(std::move(loop));
    }
    return loops;
}

/// Vertices of a loop that runs through a handle. Grow a tree over the faces (each boundary loop counts as one
/// more face), then a tree over the vertices that crosses no dual-tree edge; an edge in neither closes a handle
/// loop (tree and cotree; Eppstein 2003).
std::vector<Index> find_handle_loop(const Surface& surface)
{
    const Index face_count = static_cast<Index>(surface.triangles.rows());
    const Index halfedge_count = 3 * face_count;

    // The nodes of the dual graph: the faces, then the loops.
    std::vector<Index> loop_of(surface.vertex_count, -1);
    for (std::size_t k = 0; k < surface.loops.size(); ++k)
        for (const Index v : surface.loops[k]) loop_of[v] = static_cast<Index>(k);
    std::vector<std::vector<Index>> loop_halfedges(surface.loops.size());
    for (Index h = 0; h < halfedge_count; ++h)
        if (surface.twin[h] == no_twin) loop_halfedges[loop_of[origin(surface.triangles, h)]].push_back(h);

    // The tree, from face 0 over the dual edges.
    std::vector<char> dual_tree(halfedge_count, 0);
    std::vector<char> visited(face_count + surface.loops.size(), 0);
    std::vector<Index> queue{0};
    visited[0] = 1;
    const auto cross = [&](Index h, Index node) {
        if (visited[node]) return;
        visited[node] = 1;
        dual_tree[h] = 1;
        if (surface.twin[h] != no_twin) dual_tree[surface.twin[h]] = 1;
        queue.push_back(node);
    };
    for (std::size_t head = 0; head < queue.size(); ++head) {
        const Index node = queue[head];
        if (node < face_count) {
            for (Index h = 3 * node; h < 3 * node + 3; ++h)
                cross(h, surface.twin[h] != no_twin ? face_of(surface.twin[h])
                                                    : face_count + loop_of[origin(surface.triangles, h)]);
        } else {
            for (const Index h : loop_halfedges[node - face_count]) cross(h, face_of(h));
        }
    }

    // The cotree: over the vertices, along edges that the tree does not cross.
    std::vector<std::vector<Index>> outgoing(surface.vertex_count);
    for (Index h = 0; h < halfedge_count; ++h) {
        if (dual_tree[h]) continue;
        outgoing[origin(surface.triangles, h)].push_back(target(surface.triangles, h));
        if (surface.twin[h] == no_twin) outgoing[target(surface.triangles, h)].push_back(origin(surface.triangles, h));
    }
    std::vector<Index> parent(surface.vertex_count, -1);
    const Index root = origin(surface.triangles, 0);
    parent[root] = root;
    queue.assign(1, root);
    for (std::size_t head = 0; head < queue.size(); ++head)
        for (const Index w : outgoing[queue[head]])
            if (parent[w] < 0) {
                parent[w] = queue[head];
                queue.push_back(w);
            }
    // An edge in neither, and the two paths from its ends to where they meet.
    const auto path_to_root = [&](Index v) {
        std::vector<Index> path{v};
        while (parent[v] != v) path.push_back(v = parent[v]);
        return path;
    };
    for (Index v = 0; v < surface.vertex_count; ++v)
        for (const Index w : outgoing[v]) {
            if (parent[v] == w || parent[w] == v) continue;
            std::vector<Index> a = path_to_root(v), b = path_to_root(w);
            while (a.size() > 1 && b.size() > 1 && a[a.size() - 2] == b[b.size() - 2]) {
                a.pop_back();
                b.pop_back();
            }
            a.insert(a.end(), b.rbegin() + 1, b.rend());
            return a;
        }
    return {};
}

}  // namespace

void require_finite(const Vertices& vertices)
{
    const std::vector<Index> bad =
        found_in_pieces(static_cast<Index>(vertices.rows()), [&](Index v) { return !vertices.row(v).allFinite(); });
    if (!bad.empty())
        throw InputError(std::to_string(bad.size()) + " vertices have a coordinate that is NaN or infinite",
                         ElementKind::vertices, bad);
}

void validate_arrays(const Vertices& vertices, const Triangles& triangles)
{
    if (vertices.rows() == 0) throw InputError("the mesh has no vertices");
    if (triangles.rows() == 0) throw InputError("the mesh has no faces");
    require_finite(vertices);
    const Index faces = static_cast<Index>(triangles.rows());
    std::vector<Index> bad = found_in_pieces(faces, [&](Index f) {
        return triangles.row(f).minCoeff() < 0 || triangles.row(f).maxCoeff() >= vertices.rows();
    });
    if (!bad.empty())
        throw InputError(std::to_string(bad.size()) + " faces name a vertex that does not exist (faces listed)",
                         ElementKind::faces, bad);
    bad = found_in_pieces(faces, [&](Index f) {
        return triangles(f, 0) == triangles(f, 1) || triangles(f, 1) == triangles(f, 2) ||
               triangles(f, 2) == triangles(f, 0);
    });
    if (!bad.empty())
        throw InputError(std::to_string(bad.size()) + " faces name the same vertex twice (faces listed)",
                         ElementKind::faces, bad);
}

Surface analyze_surface(const Triangles& triangles, Index vertex_count)
{
    Surface surface;
    surface.triangles = triangles;
    surface.vertex_count = vertex_count;
    // Twins, then one orientation, then discs or half-discs around all vertices.
    surface.twin = pair_halfedges(triangles, vertex_count);
    if (!is_in_order(triangles, surface.twin)) {
        Orientation orientation = orient_faces(triangles, surface.twin);
        require_one_component(orientation);
        apply_orientation(surface, std::move(orientation.reversed));
    }
    require_manifold_vertices(surface);
    // Boundary loops are chains of halfedges without a twin.
    const std::vector<Index> rim =
        found_in_pieces(static_cast<Index>(surface.twin.size()), [&](Index h) { return surface.twin[h] == no_twin; });
    surface.loops = find_loops(surface, rim);

    // chi = V - E + F = 2 - 2 g - loops.
    const std::vector<char> unused = unused_vertices(triangles, vertex_count);
    for (Index v = 0; v < vertex_count; ++v)
        if (unused[v]) surface.unused.push_back(v);
    const auto boundary_edges = static_cast<std::ptrdiff_t>(rim.size());
    const auto faces = static_cast<std::ptrdiff_t>(triangles.rows());
    const auto edges = (3 * faces + boundary_edges) / 2;
    const auto vertices = vertex_count - static_cast<std::ptrdiff_t>(surface.unused.size());
    surface.euler_characteristic = static_cast<int>(vertices - edges + faces);
    surface.genus = (2 - surface.euler_characteristic - static_cast<int>(surface.loops.size())) / 2;
    return surface;
}

Surface require_bordered_genus_zero(const Triangles& triangles, Index vertex_count)
{
    Surface surface = analyze_surface(triangles, vertex_count);
    if (surface.genus != 0)
        throw TopologyError(TopologyKind::genus,
                            "genus " + std::to_string(surface.genus) +
                                ": the surface has a handle; cut it, or delete faces across it "
                                "(vertices of a loop through it listed)",
                            find_handle_loop(surface));
    if (surface.loops.empty())
        throw TopologyError(TopologyKind::closed,
                            "the surface is closed: delete a face or mark a seam to open it (a face listed)", {0});
    return surface;
}

std::vector<char> boundary_mask(const Surface& surface)
{
    std::vector<char> mask(surface.vertex_count, 0);
    for (const VertexLoop& loop : surface.loops)
        for (const Index v : loop) mask[v] = 1;
    return mask;
}

}  // namespace koebe
