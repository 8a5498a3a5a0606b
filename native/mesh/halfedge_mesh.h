// OpenMesh's half-edge mesh, and the only place that calls its add_face.
#pragma once

#include "core/types.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

namespace koebe {

struct DoublePoints : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};

using HalfedgeMesh = OpenMesh::TriMesh_ArrayKernelT<DoublePoints>;

/// Adds a triangle. OpenMesh's own add_face prints and returns an invalid handle where this throws.
/// @throws InputError a vertex that does not exist, or the same one twice
/// @throws TopologyError nonmanifold_edge: the edge already has a face on that side (elements: its vertices);
///         nonmanifold_vertex: the vertex is closed, or would join separate fans (elements: the vertices)
HalfedgeMesh::FaceHandle add_triangle(HalfedgeMesh& mesh, Index a, Index b, Index c);

/// Half-edge mesh with the same vertices and faces in the same order.
/// @throws as add_triangle
HalfedgeMesh to_halfedge_mesh(const Vertices& vertices, const Triangles& triangles);

struct MeshArrays {
    Vertices vertices;
    Triangles triangles;
};

/// Back to arrays: order of vertices and faces kept, each face from the corner that to_halfedge_mesh put first.
MeshArrays to_arrays(const HalfedgeMesh& mesh);

}  // namespace koebe
