// Faces joined over some of their edges; all other edges are seams.
#pragma once

#include "core/connectivity.h"
#include "core/types.h"

#include <array>
#include <utility>
#include <vector>

namespace koebe {

/// Oriented triangles whose half-edges are joined in opposite pairs or not at all. Its vertices are fans: corners
/// joined round one vertex of the input. So it is manifold for every input.
struct SeamedMesh {
    Triangles corners;           ///< (F, 3) vertices of the input
    std::vector<Index> face;     ///< (F) of the input, ascending
    std::vector<char> turned;    ///< (F) 1 where the second and third corner are exchanged against the input
    std::vector<Index> twin;     ///< (3F) or no_twin at a seam and on the boundary
    std::vector<char> whole;     ///< (3F) 1 inside a polygon: must not be cut
    std::vector<double> length;  ///< (3F) of each edge, in units of the input's extent
    Triangles fans;              ///< (F, 3) from 0 to fan_count
    Index fan_count = 0;

    Index halfedge_count() const { return static_cast<Index>(twin.size()); }
    void cut(Index halfedge);
    void join(Index halfedge, Index other)
    {
        twin[halfedge] = other;
        twin[other] = halfedge;
    }
};

/// Numbers the fans again after the twins have changed.
void number_fans(SeamedMesh& mesh);

/// The vertex of the input at which each fan is.
std::vector<Index> vertices_of_fans(const SeamedMesh& mesh);

/// Joins seams that separate nothing: both sides have the same fans at their ends. The fans do not change.
void join_idle_seams(SeamedMesh& mesh);

/// The connected parts by lowest face, each with its own fan numbers.
std::vector<SeamedMesh> connected_parts(const SeamedMesh& mesh);

/// Half-edges of each boundary loop in order.
std::vector<std::vector<Index>> boundary_halfedges(const SeamedMesh& mesh);

/// The genus of a connected mesh with so many boundary loops.
int genus_of(const SeamedMesh& mesh, std::size_t loops);

}  // namespace koebe
