// OpenMesh's half-edge mesh. Only this file calls its add_face.
#pragma once

#include "core/types.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

namespace koebe {

struct DoublePoints : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};

using HalfedgeMesh = OpenMesh::TriMesh_ArrayKernelT<DoublePoints>;

/// Adds a triangle. Throws where OpenMesh's own add_face would print and return an invalid handle.
/// @throws InputError a vertex that does not exist, or the same one twice
/// @throws TopologyError nonmanifold_edge: the edge already has a face on that side (elements: its vertices);
///         nonmanifold_vertex: the vertex is closed, or would join separate fans (elements: the vertices)
HalfedgeMesh::FaceHandle add_triangle(HalfedgeMesh& mesh, Index a, Index b, Index c);

/// Makes a half-edge mesh with the same vertices and faces in the same order.
/// @throws as add_triangle
HalfedgeMesh to_halfedge_mesh(const Vertices& vertices, const Triangles& triangles);

struct MeshArrays {
    Vertices vertices;
    Triangles triangles;
};

/// Makes arrays again. Vertices and faces keep their order; each face starts at the corner that it had first before.
MeshArrays to_arrays(const HalfedgeMesh& mesh);

}  // namespace koebe
