#include "mesh/halfedge_mesh.h"

#include "core/errors.h"
#include "core/process_setting.h"

#include <string>

namespace koebe {
namespace {

/// OpenMesh prints errors on its error stream. The library never prints.
struct OpenMeshErrorsDisabled {
    OpenMeshErrorsDisabled() { omerr().disable(); }
    ~OpenMeshErrorsDisabled() { omerr().enable(); }
};
using SilentOpenMesh = ProcessSetting<OpenMeshErrorsDisabled>;

void require_free_edge(const HalfedgeMesh& mesh, HalfedgeMesh::VertexHandle from, HalfedgeMesh::VertexHandle to)
{
    const auto halfedge = mesh.find_halfedge(from, to);
    if (halfedge.is_valid() && !mesh.is_boundary(halfedge))
        throw TopologyError(TopologyKind::nonmanifold_edge,
                            "the edge from vertex " + std::to_string(from.idx()) + " to " + std::to_string(to.idx()) +
                                " already has a face on that side",
                            {from.idx(), to.idx()});
}

}  // namespace

HalfedgeMesh::FaceHandle add_triangle(HalfedgeMesh& mesh, Index a, Index b, Index c)
{
    const Index corners[3] = {a, b, c};
    HalfedgeMesh::VertexHandle handles[3];
    for (int k = 0; k < 3; ++k) {
        if (corners[k] < 0 || corners[k] >= static_cast<Index>(mesh.n_vertices()))
            throw InputError("a face names vertex " + std::to_string(corners[k]) + ", which does not exist");
        if (corners[k] == corners[(k + 1) % 3])
            throw InputError("a face names vertex " + std::to_string(corners[k]) + " twice", ElementKind::vertices,
                             {corners[k]});
        handles[k] = HalfedgeMesh::VertexHandle(corners[k]);
    }
    for (int k = 0; k < 3; ++k) require_free_edge(mesh, handles[k], handles[(k + 1) % 3]);
    for (const auto vertex : handles)
        if (!mesh.is_boundary(vertex))
            throw TopologyError(TopologyKind::nonmanifold_vertex,
                                "vertex " + std::to_string(vertex.idx()) + " is closed: no face can be added there",
                                {vertex.idx()});
    const SilentOpenMesh silent;
    const auto face = mesh.add_face(handles, 3);
    if (!face.is_valid())
        throw TopologyError(TopologyKind::nonmanifold_vertex,
                            "a face cannot be linked with the fans round its vertices (vertices listed)", {a, b, c});
    return face;
}

HalfedgeMesh to_halfedge_mesh(const Vertices& vertices, const Triangles& triangles)
{
    HalfedgeMesh mesh;
    mesh.reserve(vertices.rows(), vertices.rows() + triangles.rows() + 1, triangles.rows());
    for (Eigen::Index v = 0; v < vertices.rows(); ++v)
        mesh.add_vertex(OpenMesh::Vec3d(vertices(v, 0), vertices(v, 1), vertices(v, 2)));
    for (Eigen::Index f = 0; f < triangles.rows(); ++f)
        add_triangle(mesh, triangles(f, 0), triangles(f, 1), triangles(f, 2));
    return mesh;
}

MeshArrays to_arrays(const HalfedgeMesh& mesh)
{
    MeshArrays arrays;
    arrays.vertices.resize(static_cast<Eigen::Index>(mesh.n_vertices()), 3);
    arrays.triangles.resize(static_cast<Eigen::Index>(mesh.n_faces()), 3);
    for (const auto vertex : mesh.vertices()) {
        const OpenMesh::Vec3d& p = mesh.point(vertex);
        arrays.vertices.row(vertex.idx()) << p[0], p[1], p[2];
    }
    for (const auto face : mesh.faces()) {
        // OpenMesh keeps the half-edge that ends at the first corner.
        auto halfedge = mesh.next_halfedge_handle(mesh.halfedge_handle(face));
        for (int k = 0; k < 3; ++k, halfedge = mesh.next_halfedge_handle(halfedge))
            arrays.triangles(face.idx(), k) = mesh.from_vertex_handle(halfedge).idx();
    }
    return arrays;
}

}  // namespace koebe
