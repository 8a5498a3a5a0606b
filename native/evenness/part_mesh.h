// A part of a surface as a surface of its own.
#pragma once

#include "core/types.h"
#include "mesh/topology.h"

#include <vector>

namespace koebe {

/// What is cut: a connected, oriented, manifold surface of genus 0, in a unit in which all surfaces that are cut
/// together have area 1. With boundary, unless it is cut in two before anything else (closed_surface.h).
struct CutSurface {
    Vertices vertices;
    Surface surface;
    VectorXd areas;              ///< (F)
    VectorXd lengths;            ///< (3F) of each half-edge
    std::vector<Index> polygon;  ///< (F) faces of one number are not cut apart; empty: each is one by itself
    std::vector<char> slit;      ///< (3F) 1 where tubes are to be opened; empty: nowhere in particular
    std::vector<char> seam;      ///< (3F) 1 on a boundary that is a cut; empty: on none
};

/// (F) areas of faces. @param vertices of a size that its square does not overflow
VectorXd face_areas(const Vertices& vertices, const Triangles& triangles);

CutSurface cut_surface(const Vertices& vertices, Surface surface, std::vector<Index> polygon);

/// @throws TopologyError as require_bordered_genus_zero
CutSurface cut_surface(const Vertices& vertices, const Triangles& triangles, std::vector<Index> polygon);

/// Some faces of a surface, their vertices split where the faces hang together by a vertex alone: a manifold.
struct PartMesh {
    std::vector<Index> faces;     ///< of the whole, rising
    std::vector<Index> original;  ///< vertex of the whole, for each vertex
    Vertices vertices;
    Surface surface;
    VectorXd areas;              ///< (F) in the unit of the whole
    std::vector<Index> polygon;  ///< (F) as of the whole
    std::vector<char> slit;      ///< (3F) as of the whole
    std::vector<char> border;    ///< (V) 1 on the boundary of the input itself, which is no cut
    double area = 0.0;
};

/// @param faces connected by edges @throws TopologyError as require_bordered_genus_zero: a closed surface
PartMesh part_mesh(const CutSurface& whole, std::vector<Index> faces);

/// The same of all faces of a closed surface too, which is no part.
PartMesh some_or_all(const CutSurface& whole, std::vector<Index> faces);

/// The pieces of a labelled part that are connected by edges. @param label (F) of the part's faces
/// @return the piece of each face, from 0
std::vector<Index> connected_pieces(const PartMesh& part, const std::vector<int>& label, Index& count);

/// The faces of the whole in each of these pieces, rising; none without a label.
std::vector<std::vector<Index>> pieces_of(const PartMesh& part, const std::vector<int>& label);

}  // namespace koebe
