#include "splitting/coarse_surface.h"

#include "mesh/halfedge_mesh.h"
#include "surface/face_vectors.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
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

class Coarsening {
public:
    Coarsening(const Vertices& vertices, const Triangles& triangles, const std::vector<Index>& image,
               const std::vector<char>& border)
        : mesh(to_halfedge_mesh(vertices, analyze_surface(triangles, static_cast<Index>(vertices.rows())))),
          parent(static_cast<std::size_t>(vertices.rows())),
          image_(image),
          border_(border),
          reach_(parent.size(), 0.0),
          around_(parent.size(), 0)
    {
        for (const Index v : triangles.reshaped()) ++around_[v];
        note_tips(vertices, triangles);
        mesh.request_vertex_status();
        mesh.request_halfedge_status();
        mesh.request_edge_status();
        mesh.request_face_status();
        for (std::size_t v = 0; v < parent.size(); ++v) parent[v] = static_cast<Index>(v);
    }

    void run(Index faces, ExecutionContext& context)
    {
        std::vector<Entry> entries;
        for (int e = 0; e < static_cast<int>(mesh.n_edges()); ++e)
            entries.emplace_back(reach_after(first_choice(Edge(e))), e);
        queue_ = Queue(std::greater<>(), std::move(entries));
        left_ = static_cast<Index>(mesh.n_faces());
        for (long step = 0; left_ > faces && !queue_.empty(); ++step) {
            if (step % 4096 == 0) context.checkpoint();
            const auto [length, edge] = queue_.top();
            queue_.pop();
            if (mesh.status(Edge(edge)).deleted()) continue;
            Halfedge h = first_choice(Edge(edge));
            if (reach_after(h) != length) continue;
            if (!may_collapse(h)) {
                h = mesh.opposite_halfedge_handle(h);
                if (!may_collapse(h) || is_tip_of_border(h, length)) continue;
            }
            const auto [image, is_alone] = image_of(h);
            if (!is_alone && (!image.is_valid() || !may_collapse(image))) continue;
            collapse(h);
            if (image.is_valid() && !mesh.status(mesh.edge_handle(image)).deleted() && may_collapse(image))
                collapse(image);
        }
    }

    HalfedgeMesh mesh;
    std::vector<Index> parent;  // (V) the vertex that a vertex went to; itself if it stayed

private:
    using Edge = HalfedgeMesh::EdgeHandle;
    using Entry = std::pair<double, int>;  // reach, edge; out of date where the edge has another one now
    using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;

    /// The tip of a cone stays for as long as an edge that is as long as its faces' edges together.
    void note_tips(const Vertices& vertices, const Triangles& triangles)
    {
        const VectorXd angle = angle_sums(vertices, triangles);
        std::vector<double> around(parent.size(), 0.0);
        for (const auto face : triangles.rowwise())
            for (int k = 0; k < 3; ++k)
                around[face[k]] += (vertices.row(face[(k + 1) % 3]) - vertices.row(face[k])).norm();
        for (std::size_t v = 0; v < parent.size(); ++v) {
            const Vertex own(static_cast<int>(v));
            const double sides = on_border(own) ? 2.0 : 1.0;  // half of the faces round it are here
            if (on_border(own) || !mesh.is_boundary(own))
                reach_[v] = std::abs(1.0 - sides * angle[static_cast<Eigen::Index>(v)] / (2.0 * std::numbers::pi)) *
                            sides * around[v];
        }
    }

    Halfedge first_choice(Edge e) const
    {
        const Halfedge h = mesh.halfedge_handle(e, 0), t = mesh.halfedge_handle(e, 1);
        return reach_[mesh.from_vertex_handle(h).idx()] <= reach_[mesh.from_vertex_handle(t).idx()] ? h : t;
    }

    double reach_after(Halfedge h) const
    {
        const Vertex from = mesh.from_vertex_handle(h), to = mesh.to_vertex_handle(h);
        return reach_[from.idx()] + (mesh.point(from) - mesh.point(to)).norm();
    }

    /// Whether no face is turned over when the half-edge's origin goes to its target.
    bool stays_upright(Halfedge h) const
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

    /// Whether a half-edge leaves a tip on the border, for which it is too short. @param reach of the opposite one
    bool is_tip_of_border(Halfedge h, double reach) const
    {
        return on_border(mesh.from_vertex_handle(h)) && reach_after(h) > 2.0 * reach;
    }

    bool on_border(Vertex v) const { return !border_.empty() && border_[v.idx()]; }

    bool keeps_border(Halfedge h) const
    {
        const Vertex from = mesh.from_vertex_handle(h), to = mesh.to_vertex_handle(h);
        if (on_border(from)) {
            if (!on_border(to) || !mesh.is_boundary(mesh.edge_handle(h))) return false;
            for (auto out = mesh.cvoh_iter(from); out.is_valid(); ++out)
                if (mesh.is_boundary(mesh.edge_handle(*out)) && !on_border(mesh.to_vertex_handle(*out))) return false;
        }
        if (!on_border(to)) return true;
        for (auto out = mesh.cvoh_iter(from); out.is_valid(); ++out) {
            const Vertex other = mesh.to_vertex_handle(*out);
            if (other == to || !on_border(other)) continue;
            const Halfedge across = mesh.find_halfedge(to, other);
            if (on_border(from) ? !mesh.is_boundary(mesh.edge_handle(*out))
                                : !across.is_valid() || !mesh.is_boundary(mesh.edge_handle(across)))
                return false;
        }
        return true;
    }

    bool may_collapse(Halfedge h)
    {
        if (is_hub(mesh.from_vertex_handle(h))) return false;
        if (mesh.is_boundary(mesh.from_vertex_handle(h)) && !mesh.is_boundary(mesh.edge_handle(h))) return false;
        const bool is_manifold = is_hub(mesh.to_vertex_handle(h)) ? stays_manifold_at_hub(h) : mesh.is_collapse_ok(h);
        return keeps_border(h) && is_manifold && stays_upright(h);
    }

    /// The mirror image of a half-edge; and whether it has none because its vertices have none.
    std::pair<Halfedge, bool> image_of(Halfedge h) const
    {
        if (image_.empty()) return {Halfedge(), true};
        const Index from = image_[mesh.from_vertex_handle(h).idx()];
        const Index to = image_[mesh.to_vertex_handle(h).idx()];
        if (from < 0 || to < 0 || mesh.status(Vertex(from)).deleted() || mesh.status(Vertex(to)).deleted())
            return {Halfedge(), true};
        return {mesh.find_halfedge(Vertex(from), Vertex(to)), false};
    }

    void collapse(Halfedge h)
    {
        const Vertex from = mesh.from_vertex_handle(h), to = mesh.to_vertex_handle(h);
        const bool at_hub = is_hub(to);
        std::vector<Edge> changed;  // edges with another end or reach
        if (at_hub) changed.assign(mesh.cve_begin(from), mesh.cve_end(from));
        around_[to.idx()] += around_[from.idx()] - 2;
        left_ -= mesh.is_boundary(mesh.edge_handle(h)) ? 1 : 2;
        reach_[to.idx()] = std::max(reach_[to.idx()], reach_after(h));
        mesh.collapse(h);
        parent[from.idx()] = to.idx();
        if (!at_hub) changed.assign(mesh.cve_begin(to), mesh.cve_end(to));
        for (const Edge next : changed)
            if (!mesh.status(next).deleted()) queue_.emplace(reach_after(first_choice(next)), next.idx());
    }

    bool is_hub(Vertex v) const { return around_[v.idx()] > hub_faces; }

    /// The link condition, without a walk round the target: both ends have only the opposite corners in common, and the
    /// edge does not join two places of the boundary.
    bool stays_manifold_at_hub(Halfedge h) const
    {
        const Vertex from = mesh.from_vertex_handle(h), to = mesh.to_vertex_handle(h);
        const Halfedge back = mesh.opposite_halfedge_handle(h);
        if (mesh.is_boundary(from) && mesh.is_boundary(to) && !mesh.is_boundary(mesh.edge_handle(h))) return false;
        int common = 0;
        for (auto v = mesh.cvv_iter(from); v.is_valid(); ++v)
            common += *v != to && mesh.find_halfedge(*v, to).is_valid();
        return common == !mesh.is_boundary(h) + !mesh.is_boundary(back);
    }

    const std::vector<Index>& image_;  // (V)
    const std::vector<char>& border_;  // (V)
    // (V) how far a vertex has drawn others: without it a vertex would go along a row of equal edges to its end.
    std::vector<double> reach_;
    std::vector<int> around_;  // (V) about the number of faces
    Queue queue_;
    Index left_ = 0;  // faces
};

}  // namespace

CoarseSurface coarse_surface(const Vertices& vertices, const Triangles& triangles, Index faces,
                             const std::vector<Index>& image, ExecutionContext& context,
                             const std::vector<char>& border)
{
    Coarsening coarsening(vertices, triangles, image, border);
    coarsening.run(faces, context);
    const HalfedgeMesh& mesh = coarsening.mesh;
    std::vector<Index>& parent = coarsening.parent;
    CoarseSurface coarse;
    // The faces that are left, with vertices numbered as they come.
    std::vector<Index> number(parent.size(), -1);
    std::vector<Eigen::RowVector3i> rows;
    for (Index f = 0; f < static_cast<Index>(mesh.n_faces()); ++f) {
        const auto handle = mesh.face_handle(static_cast<unsigned>(f));
        if (mesh.status(handle).deleted()) continue;
        Eigen::RowVector3i row;
        int k = 0;
        for (auto v = mesh.cfv_iter(handle); v.is_valid(); ++v, ++k) {
            Index& own = number[v->idx()];
            if (own < 0) {
                own = static_cast<Index>(coarse.vertex.size());
                coarse.vertex.push_back(v->idx());
            }
            row[k] = own;
        }
        rows.push_back(row);
    }
    coarse.vertices = vertices(coarse.vertex, Eigen::all);
    coarse.triangles.resize(static_cast<Eigen::Index>(rows.size()), 3);
    for (std::size_t f = 0; f < rows.size(); ++f) coarse.triangles.row(static_cast<Eigen::Index>(f)) = rows[f];
    // Where the other vertices went.
    coarse.vertex_at.resize(parent.size());
    for (std::size_t v = 0; v < parent.size(); ++v) {
        Index root = static_cast<Index>(v);
        while (parent[root] != root) root = parent[root] = parent[parent[root]];
        coarse.vertex_at[v] = number[root];
    }
    return coarse;
}

}  // namespace koebe
