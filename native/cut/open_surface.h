// Any triangle mesh as surfaces that can be mapped: oriented, manifold, without handles, with a boundary.
#pragma once

#include "core/api.h"
#include "core/types.h"
#include "execution/execution.h"

#include <vector>

namespace koebe {

enum class CutKind {
    crowded_edge,  ///< edges of three or more faces: seams
    orientation,   ///< edges across which a one-sided surface changes its side
    bow_tie,       ///< vertices that join separate fans of faces; each fan has its own
    handle,        ///< a loop through a handle
    opening,       ///< a slit in a surface that has no boundary, or only those of its handles' cuts
};

/// As in the JSON report: the enumerator's name.
KOEBE_API const char* to_string(CutKind kind) noexcept;

struct SurfaceCut {
    CutKind kind;
    /// Of the input. A path along edges, the first one again at the end if it is closed; for bow ties no path, but all
    /// such vertices, rising.
    std::vector<Index> vertices;
};

/// A connected, oriented, manifold surface of genus 0 with one boundary loop at least: what `uniformize` takes.
struct SurfacePiece {
    Vertices vertices;                 ///< (V', 3) the input's positions
    Triangles triangles;               ///< (F', 3) the input's corners in their order, but for turned faces
    std::vector<Index> source_vertex;  ///< (V') of the input
    std::vector<Index> source_face;    ///< (F') of the input, rising
    std::vector<char> turned;          ///< (F') 1 where the second and third corner have changed places
};

struct LeftOutFace {
    Index face;       ///< names a vertex twice, or has the vertices of another face
    Index like;       ///< the face whose place it takes: that with the same vertices, or a neighbour; -1: none
    bool degenerate;  ///< names a vertex twice
};

struct OpenedSurface {
    std::vector<SurfacePiece> pieces;   ///< by their lowest face
    std::vector<SurfaceCut> cuts;       ///< in the order of CutKind
    std::vector<LeftOutFace> left_out;  ///< rising; each other face is in exactly one piece
    int handles = 0;                    ///< that were cut
};

struct OpenOptions {
    /// (F) faces of one number are parts of one polygon, and are not cut apart; empty: each face is one by itself.
    std::vector<Index> polygon = {};
    /// A surface without boundary, or whose loops are those of its handles' cuts, is opened by a long slit, which keeps
    /// the areas of its map even. false: by one of two edges, and only where there is no boundary.
    bool long_slit = true;
    /// false: the loops of handles' cuts are boundary enough: what was a torus stays a tube.
    bool slit_beside_handles = true;
};

/// Opens, cuts and splits a mesh until every piece can be mapped. The mesh itself does not change.
///
/// Degenerate and duplicate faces are left out. Faces are turned to one orientation along a spanning forest; edges of
/// three or more faces, and those across which the sides still disagree, become seams; corners joined over the other
/// edges are one vertex. A handle is cut along a short loop of a greedy homology basis [Erickson and Whittlesey,
/// Greedy optimal homotopy and homology generators, 2005, section 3], each hole being one node of the dual graph. A
/// closed surface is opened along a shortest path between vertices far apart.
///
/// @param vertices (V, 3) finite @param triangles (F, 3) indices in range, else anything
/// @throws InputError arrays that are no mesh, no face with three different vertices; Cancelled
KOEBE_API OpenedSurface open_surface(const Vertices& vertices, const Triangles& triangles, const OpenOptions& options,
                                     ExecutionContext& context);

/// The same without progress, never cancelled.
OpenedSurface open_surface(const Vertices& vertices, const Triangles& triangles, const OpenOptions& options = {});

}  // namespace koebe
