// OpenMesh's half-edge mesh.
#pragma once

#include "core/types.h"
#include "mesh/topology.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

namespace koebe {

struct DoublePoints : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};

using HalfedgeMesh = OpenMesh::TriMesh_ArrayKernelT<DoublePoints>;

/// Makes a half-edge mesh with the same vertices and faces in the same order. It takes the twins from the surface:
/// OpenMesh's add_face looks for each edge round its vertex, which takes the square of a vertex's faces.
HalfedgeMesh to_halfedge_mesh(const Vertices& vertices, const Surface& surface);

struct MeshArrays {
    Vertices vertices;
    Triangles triangles;
};

/// Makes arrays again. Vertices and faces keep their order; each face starts at the corner that it had first before.
MeshArrays to_arrays(const HalfedgeMesh& mesh);

}  // namespace koebe
