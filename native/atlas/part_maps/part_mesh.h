// Makes a part of a surface a surface of its own.
#pragma once

#include "core/types.h"
#include "mesh/topology.h"

#include <vector>

namespace koebe {

/// What the maps of parts are for: only to judge where to cut, or to be stored. Judging maps are rougher, and keep
/// their flaws.
enum class MapPurpose { judging, result };

/// The surface to cut: connected, oriented, manifold, of genus 0. Scaled so that all surfaces that are cut together
/// have area 1. It has a boundary, unless it is first cut in two (closed_surface.h).
struct CutSurface {
    Vertices vertices;
    Surface surface;
    VectorXd areas;              ///< (F)
    VectorXd lengths;            ///< (3F) lengths of half-edges
    std::vector<Index> polygon;  ///< (F) faces with the same number are not cut apart; empty: all may be
    std::vector<Index> face;     ///< (F) pieces of a divided face have one number; empty: no face is divided
    std::vector<char> slit;      ///< (3F) 1 where tubes should be opened; empty: no wish
    std::vector<char> seam;      ///< (3F) 1 on a boundary that is a cut; empty: no boundary is
    std::vector<double> shown;   ///< (V) factor on the length of cuts, as they are seen there; empty: 1
    MapPurpose purpose = MapPurpose::result;  ///< of maps of its parts
};

/// (F) areas of faces. @param vertices (V, 3), not so large that squares overflow
VectorXd face_areas(const Vertices& vertices, const Triangles& triangles);

CutSurface cut_surface(const Vertices& vertices, Surface surface, std::vector<Index> polygon);

/// @throws TopologyError as require_bordered_genus_zero
CutSurface cut_surface(const Vertices& vertices, const Triangles& triangles, std::vector<Index> polygon);

/// Some faces of a surface, as a manifold: a vertex is split if its faces share no edge there.
struct PartMesh {
    std::vector<Index> faces;     ///< faces of the whole, ascending
    std::vector<Index> original;  ///< (V) the vertex of the whole
    Vertices vertices;
    Surface surface;
    VectorXd areas;              ///< (F) in the unit of the whole
    std::vector<Index> polygon;  ///< (F) as in CutSurface
    std::vector<char> slit;      ///< (3F) as in CutSurface
    std::vector<double> shown;   ///< (V) as in CutSurface
    std::vector<char> border;    ///< (V) 1 on the boundary of the input itself, where nothing was cut
    double area = 0.0;
};

/// The length of an edge as a cut, with its factor where it is seen (cost/costs.h).
double length_as_cut(const CutSurface& whole, Index halfedge);

/// @param faces connected by edges @throws TopologyError as require_bordered_genus_zero: a closed surface
PartMesh part_mesh(const CutSurface& whole, std::vector<Index> faces);

/// As part_mesh. Also takes all faces of a closed surface.
PartMesh some_or_all(const CutSurface& whole, std::vector<Index> faces);

/// The pieces of equal labels that edges connect. @param label (F) labels of the part's faces
/// @return the piece of each face, from 0
std::vector<Index> connected_pieces(const PartMesh& part, const std::vector<int>& label, Index& count);

/// The faces of the whole in each of these pieces, ascending. Empty if `label` is empty.
std::vector<std::vector<Index>> pieces_of(const PartMesh& part, const std::vector<int>& label);

}  // namespace koebe
