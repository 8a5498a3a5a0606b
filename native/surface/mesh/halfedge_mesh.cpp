#include "mesh/halfedge_mesh.h"

#include "core/connectivity.h"

#include <vector>

namespace koebe {

HalfedgeMesh to_halfedge_mesh(const Vertices& vertices, const Surface& surface)
{
    using Halfedge = HalfedgeMesh::HalfedgeHandle;
    using Vertex = HalfedgeMesh::VertexHandle;
    const auto count = static_cast<Index>(surface.twin.size());
    HalfedgeMesh mesh;
    mesh.reserve(vertices.rows(), vertices.rows() + surface.triangles.rows() + 1, surface.triangles.rows());
    for (Eigen::Index v = 0; v < vertices.rows(); ++v)
        mesh.add_vertex(OpenMesh::Vec3d(vertices(v, 0), vertices(v, 1), vertices(v, 2)));
    std::vector<Halfedge> handle(surface.twin.size());
    for (Index h = 0; h < count; ++h) {
        if (handle[h].is_valid()) continue;
        handle[h] = mesh.new_edge(Vertex(origin(surface.triangles, h)), Vertex(target(surface.triangles, h)));
        if (surface.twin[h] != no_twin) handle[surface.twin[h]] = mesh.opposite_halfedge_handle(handle[h]);
    }
    // Faces, each with the half-edge that ends at its first corner.
    for (Index h = 0; h < count; h += 3) {
        const auto face = mesh.new_face();
        mesh.set_halfedge_handle(face, handle[h + 2]);
        for (Index k = 0; k < 3; ++k) {
            mesh.set_face_handle(handle[h + k], face);
            mesh.set_next_halfedge_handle(handle[h + k], handle[h + (k + 1) % 3]);
            mesh.set_halfedge_handle(Vertex(origin(surface.triangles, h + k)), handle[h + k]);
        }
    }
    // The boundary runs the other way. A boundary vertex keeps its outgoing half-edge on the boundary.
    for (Index h = 0; h < count; ++h)
        if (surface.twin[h] == no_twin)
            mesh.set_halfedge_handle(Vertex(target(surface.triangles, h)), mesh.opposite_halfedge_handle(handle[h]));
    for (Index h = 0; h < count; ++h)
        if (surface.twin[h] == no_twin)
            mesh.set_next_halfedge_handle(mesh.opposite_halfedge_handle(handle[h]),
                                          mesh.halfedge_handle(Vertex(origin(surface.triangles, h))));
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
