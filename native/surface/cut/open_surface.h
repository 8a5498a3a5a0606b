// Cuts any triangle mesh into surfaces that can be mapped: oriented, manifold, without handles, with a boundary.
#pragma once

#include "core/api.h"
#include "core/types.h"
#include "execution/execution.h"

#include <array>
#include <vector>

namespace koebe {

enum class CutKind {
    crowded_edge,  ///< edges of three or more faces become seams
    orientation,   ///< edges across which a one-sided surface changes sides
    bow_tie,       ///< vertices that join separate fans of faces; each fan gets its own
    handle,        ///< a loop through a handle
    opening,       ///< a slit in a surface without boundary, or with only the boundary of its handles' cuts
};

/// The enumerator's name, as in the JSON report.
KOEBE_API const char* to_string(CutKind kind) noexcept;

struct SurfaceCut {
    CutKind kind;
    /// Of the input. A path along edges; a closed path ends with its first vertex. For bow ties all such vertices
    /// instead, ascending.
    std::vector<Index> vertices;
};

/// A connected, oriented, manifold surface of genus 0 with at least one boundary loop, as `uniformize` needs it.
struct SurfacePiece {
    Vertices vertices;                 ///< (V', 3) the input's positions
    Triangles triangles;               ///< (F', 3) the input's corners in order, except in turned faces
    std::vector<Index> source_vertex;  ///< (V') of the input
    std::vector<Index> source_face;    ///< (F') of the input, ascending
    std::vector<char> turned;          ///< (F') 1 where the second and third corner are exchanged
};

/// All faces as one piece, which names them as they are.
SurfacePiece whole_piece(const Vertices& vertices, const Triangles& triangles);

struct LeftOutFace {
    Index face;       ///< names a vertex twice, or has the vertices of another face
    Index like;       ///< the face it is drawn like: with the same vertices, or a neighbour; -1: no such face
    bool degenerate;  ///< names a vertex twice
};

struct OpenedSurface {
    std::vector<SurfacePiece> pieces;   ///< by their lowest face
    std::vector<SurfaceCut> cuts;       ///< in the order of CutKind
    std::vector<LeftOutFace> left_out;  ///< ascending; each other face is in exactly one piece
    int handles = 0;                    ///< number of handles cut
};

struct OpenOptions {
    /// (F) faces of one number are one polygon, and are not cut apart; empty: each face by itself.
    std::vector<Index> polygon = {};
    std::vector<std::array<Index, 2>> seams = {};  ///< edges over which faces are not joined, as pairs of vertices
    /// Opens a surface without boundary, or with only its handles' cuts, by a long slit, which keeps the areas of its
    /// map even. false: by a slit of two edges, and only without boundary.
    bool long_slit = true;
    /// false: the cuts of handles count as boundary, so that a former torus stays a tube.
    bool slit_beside_handles = true;
    /// false: connected surfaces stay as they are, closed and with handles.
    bool open = true;
};

/// Opens, cuts and splits a mesh until every piece can be mapped. The mesh itself does not change.
///
/// Degenerate and duplicate faces are left out. Faces are turned to one orientation along a spanning forest. Edges of
/// three or more faces become seams, as do edges across which the sides still disagree. Corners joined over the other
/// edges are one vertex. A handle is cut along a short loop of a greedy homology basis [Erickson and Whittlesey, Greedy
/// optimal homotopy and homology generators, 2005, section 3], with each hole as one node of the dual graph. A closed
/// surface is opened along a shortest path between vertices far apart.
///
/// @param vertices (V, 3) finite @param triangles (F, 3) indices in range, otherwise arbitrary
/// @throws InputError the arrays are not a mesh, or no face has three different vertices; Cancelled
KOEBE_API OpenedSurface open_surface(const Vertices& vertices, const Triangles& triangles, const OpenOptions& options,
                                     ExecutionContext& context);

/// Opens the mesh without progress reports or cancelling.
OpenedSurface open_surface(const Vertices& vertices, const Triangles& triangles, const OpenOptions& options = {});

}  // namespace koebe
