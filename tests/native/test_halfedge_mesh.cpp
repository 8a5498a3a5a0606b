#include "circle_domain.h"
#include "mesh/halfedge_mesh.h"
#include "mesh/topology.h"

#include <gtest/gtest.h>

using namespace koebe;
using namespace koebe::test;

namespace {

Surface analyzed(const Triangles& triangles) { return analyze_surface(triangles, triangles.maxCoeff() + 1); }

Triangles faces(std::initializer_list<std::initializer_list<Index>> rows)
{
    Triangles triangles(static_cast<Eigen::Index>(rows.size()), 3);
    Eigen::Index f = 0;
    for (const auto& row : rows) std::copy(row.begin(), row.end(), triangles.row(f++).begin());
    return triangles;
}

}  // namespace

TEST(HalfedgeMesh, arrays_come_back_as_they_were)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 1000);
    const Vertices vertices = lift(domain.points, Lift::enneper);
    const MeshArrays back = to_arrays(to_halfedge_mesh(vertices, analyzed(domain.triangles)));
    EXPECT_EQ(back.vertices, vertices);
    EXPECT_EQ(back.triangles, domain.triangles);
}

TEST(HalfedgeMesh, vertices_of_no_face_and_64_bits_are_kept)
{
    Vertices vertices(4, 3);
    vertices << 0.1, 0.2, 0.3, 1e300, 0, 0, 0, 1e-300, 0, 1.0 / 3.0, 0, 0;
    const MeshArrays back = to_arrays(to_halfedge_mesh(vertices, analyzed(faces({{0, 3, 2}}))));
    EXPECT_EQ(back.vertices, vertices);
    EXPECT_EQ(back.triangles, faces({{0, 3, 2}}));
}

TEST(HalfedgeMesh, half_edges_are_linked_as_openmesh_links_them)
{
    const CircleDomain domain = make_circle_domain(five_circles(), 1000);
    const HalfedgeMesh mesh = to_halfedge_mesh(lift(domain.points, Lift::enneper), analyzed(domain.triangles));
    for (const auto h : mesh.halfedges()) {
        EXPECT_EQ(mesh.prev_halfedge_handle(mesh.next_halfedge_handle(h)), h);
        EXPECT_EQ(mesh.from_vertex_handle(mesh.next_halfedge_handle(h)), mesh.to_vertex_handle(h));
        EXPECT_EQ(mesh.face_handle(mesh.next_halfedge_handle(h)), mesh.face_handle(h));
    }
    for (const auto v : mesh.vertices()) {
        const auto h = mesh.halfedge_handle(v);
        EXPECT_EQ(mesh.from_vertex_handle(h), v);
        bool on_boundary = false;
        for (const auto out : mesh.voh_range(v)) on_boundary = on_boundary || mesh.is_boundary(out);
        EXPECT_EQ(mesh.is_boundary(h), on_boundary);
    }
}
