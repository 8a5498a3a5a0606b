#include "splitting/coarse_surface.h"

#include "mesh/halfedge_mesh.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

namespace koebe {
namespace {

using Vertex = HalfedgeMesh::VertexHandle;
using Halfedge = HalfedgeMesh::HalfedgeHandle;

constexpr double least_cosine = 0.2;  // of the angle by which a collapse turns a face

OpenMesh::Vec3d normal(const OpenMesh::Vec3d& a, const OpenMesh::Vec3d& b, const OpenMesh::Vec3d& c)
{
    return OpenMesh::cross(b - a, c - a);
}

/// Whether no face is turned over when the half-edge's origin goes to its target.
bool stays_upright(const HalfedgeMesh& mesh, Halfedge h)
{
    const Vertex from = mesh.from_vertex_handle(h), to = mesh.to_vertex_handle(h);
    for (auto out = mesh.cvoh_iter(from); out.is_valid(); ++out) {
        if (mesh.is_boundary(*out)) continue;
        const Vertex b = mesh.to_vertex_handle(*out), c = mesh.to_vertex_handle(mesh.next_halfedge_handle(*out));
        if (b == to || c == to) continue;
        const OpenMesh::Vec3d before = normal(mesh.point(from), mesh.point(b), mesh.point(c));
        const OpenMesh::Vec3d after = normal(mesh.point(to), mesh.point(b), mesh.point(c));
        if (!(OpenMesh::dot(before, after) > least_cosine * before.norm() * after.norm())) return false;
    }
    return true;
}

bool may_collapse(HalfedgeMesh& mesh, Halfedge h)
{
    if (mesh.is_boundary(mesh.from_vertex_handle(h)) && !mesh.is_boundary(mesh.edge_handle(h))) return false;
    return mesh.is_collapse_ok(h) && stays_upright(mesh, h);
}

}  // namespace

CoarseSurface coarse_surface(const CutSurface& whole, Index faces, ExecutionContext& context)
{
    HalfedgeMesh mesh = to_halfedge_mesh(whole.vertices, whole.surface.triangles);
    mesh.request_vertex_status();
    mesh.request_halfedge_status();
    mesh.request_edge_status();
    mesh.request_face_status();
    std::vector<Index> parent(static_cast<std::size_t>(whole.vertices.rows()));
    for (std::size_t v = 0; v < parent.size(); ++v) parent[v] = static_cast<Index>(v);

    // How far a vertex has drawn others: without it a vertex would go along a row of equal edges to its end.
    std::vector<double> reach(parent.size(), 0.0);
    const auto first_choice = [&](HalfedgeMesh::EdgeHandle e) {
        const Halfedge h = mesh.halfedge_handle(e, 0), t = mesh.halfedge_handle(e, 1);
        return reach[mesh.from_vertex_handle(h).idx()] <= reach[mesh.from_vertex_handle(t).idx()] ? h : t;
    };
    const auto reach_after = [&](Halfedge h) {
        const Vertex from = mesh.from_vertex_handle(h), to = mesh.to_vertex_handle(h);
        return reach[from.idx()] + (mesh.point(from) - mesh.point(to)).norm();
    };
    using Entry = std::pair<double, int>;  // reach, edge; out of date where the edge has another one now
    std::vector<Entry> entries;
    for (int e = 0; e < static_cast<int>(mesh.n_edges()); ++e)
        entries.emplace_back(reach_after(first_choice(HalfedgeMesh::EdgeHandle(e))), e);
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue(std::greater<>(), std::move(entries));
    auto left = static_cast<Index>(mesh.n_faces());
    for (long step = 0; left > faces && !queue.empty(); ++step) {
        if (step % 4096 == 0) context.checkpoint();
        const auto [length, edge] = queue.top();
        queue.pop();
        const HalfedgeMesh::EdgeHandle e(edge);
        if (mesh.status(e).deleted()) continue;
        Halfedge h = first_choice(e);
        if (reach_after(h) != length) continue;
        if (!may_collapse(mesh, h)) {
            h = mesh.opposite_halfedge_handle(h);
            if (!may_collapse(mesh, h)) continue;
        }
        const Vertex from = mesh.from_vertex_handle(h), to = mesh.to_vertex_handle(h);
        left -= mesh.is_boundary(e) ? 1 : 2;
        double& reached = reach[to.idx()];
        reached = std::max(reached, reach_after(h));
        mesh.collapse(h);
        parent[from.idx()] = to.idx();
        for (auto out = mesh.cvoh_iter(to); out.is_valid(); ++out) {
            const HalfedgeMesh::EdgeHandle next = mesh.edge_handle(*out);
            queue.emplace(reach_after(first_choice(next)), next.idx());
        }
    }

    CoarseSurface coarse;
    std::vector<Index> number(parent.size(), -1), kept;
    std::vector<Eigen::RowVector3i> rows;
    for (Index f = 0; f < static_cast<Index>(mesh.n_faces()); ++f) {
        const auto handle = mesh.face_handle(static_cast<unsigned>(f));
        if (mesh.status(handle).deleted()) continue;
        Eigen::RowVector3i row;
        int k = 0;
        for (auto v = mesh.cfv_iter(handle); v.is_valid(); ++v, ++k) {
            Index& own = number[v->idx()];
            if (own < 0) {
                own = static_cast<Index>(kept.size());
                kept.push_back(v->idx());
            }
            row[k] = own;
        }
        rows.push_back(row);
        coarse.face.push_back(f);
    }
    coarse.vertices = whole.vertices(kept, Eigen::all);
    coarse.triangles.resize(static_cast<Eigen::Index>(rows.size()), 3);
    for (std::size_t f = 0; f < rows.size(); ++f) coarse.triangles.row(static_cast<Eigen::Index>(f)) = rows[f];
    coarse.vertex_at.resize(parent.size());
    for (std::size_t v = 0; v < parent.size(); ++v) {
        Index root = static_cast<Index>(v);
        while (parent[root] != root) root = parent[root] = parent[parent[root]];
        coarse.vertex_at[v] = number[root];
    }
    return coarse;
}

}  // namespace koebe
