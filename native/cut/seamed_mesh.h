// Faces joined over some of their edges: all others are seams.
#pragma once

#include "core/types.h"
#include "mesh/connectivity.h"

#include <utility>
#include <vector>

namespace koebe {

/// Oriented triangles whose half-edges are joined in opposite pairs or not at all. Its vertices are fans: the corners
/// that are joined round one vertex of the input. So it is manifold whatever the input.
struct SeamedMesh {
    Triangles corners;           ///< (F, 3) vertices of the input
    std::vector<Index> face;     ///< (F) of the input, rising
    std::vector<char> turned;    ///< (F) 1 where the input has the second and third corner the other way round
    std::vector<Index> twin;     ///< (3F) or no_twin at a seam and at the boundary
    std::vector<char> whole;     ///< (3F) inside a polygon: not to be cut
    std::vector<double> length;  ///< (3F) of the edge, in units of the input's extent
    Triangles fans;              ///< (F, 3) from 0 to fan_count
    Index fan_count = 0;

    Index halfedge_count() const { return static_cast<Index>(twin.size()); }
    void cut(Index halfedge);
};

/// Numbers the fans again after a change of the twins.
void number_fans(SeamedMesh& mesh);

/// Joins seams that separate nothing: both sides have the same fans at their ends. Fans stay as they are.
void join_idle_seams(SeamedMesh& mesh);

/// The connected parts, each with its fans numbered, by their lowest face.
std::vector<SeamedMesh> connected_parts(const SeamedMesh& mesh);

/// Half-edges of each boundary loop, in order.
std::vector<std::vector<Index>> boundary_halfedges(const SeamedMesh& mesh);

/// Of a connected mesh with so many boundary loops.
int genus_of(const SeamedMesh& mesh, std::size_t loops);

struct Seams {
    SeamedMesh mesh;
    std::vector<std::pair<Index, Index>> crowded;   ///< edges of three or more faces
    std::vector<std::pair<Index, Index>> disagree;  ///< edges across which the sides cannot be made to agree
    std::vector<Index> bow_ties;                    ///< vertices with fans that no edge joins
};

/// Joins faces over all edges that have two of them, as far as these can be oriented alike.
/// @param faces of the input to take, rising, with three different vertices each, no two the same three
/// @param polygon (F) or empty, as in OpenOptions
Seams seam_faces(const Vertices& vertices, const Triangles& triangles, const std::vector<Index>& faces,
                 const std::vector<Index>& polygon);

}  // namespace koebe
