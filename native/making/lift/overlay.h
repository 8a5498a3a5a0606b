// Outlines drawn into a sheet: they become edges, and every face knows in which outline it lies.
#pragma once

#include "lift/flat_sheet.h"
#include "lift/outline.h"

#include <vector>

namespace koebe {

/// Why outlines were left out. An outline counts with its holes.
struct LeftOut {
    Index at_border = 0;            ///< they meet or enclose a hole or a rim, or meet a cut that is no period
    Index too_fine = 0;             ///< 32-bit UVs cannot hold them, or they meet themselves
    Index crossing = 0;             ///< they meet another outline
    Index open = 0;                 ///< curves of a drawing that do not close
    std::vector<Index> faces = {};  ///< where they begin: of the surface, ascending

    Index all() const { return at_border + too_fine + crossing + open; }
    void add(const LeftOut& others);
};

/// The vertices of the sheet come first, unchanged; those of the outlines follow.
struct Overlay {
    Vertices vertices, normals;
    Triangles triangles;
    std::vector<Complex> uv;                ///< (3F)
    std::vector<Index> face;                ///< (F) the sheet's face of each
    std::vector<Index> region;              ///< (F) innermost outline that holds the face, or -1
    std::vector<DrawnOutline> outlines;     ///< the outlines that were drawn
    std::vector<std::vector<Index>> loops;  ///< the vertices of each outline, in order
    LeftOut left_out;
    double drawn = 0.0;  ///< nodes of outlines, as often as they were drawn until now

    /// Whether a face lies inside an outline, and in no hole of it.
    bool in_pattern(Index f) const { return region[f] >= 0 && !outlines[region[f]].hole; }
};

/// Cuts faces along the outlines by constrained Delaunay triangulations in their charts with exact predicates. Vertices
/// of the outlines have barycentric coordinates on the surface. Outlines that cannot be drawn are left out, with their
/// group, and counted. In the result no two outlines meet. Each bounds a disk, less the
/// outlines inside: those inside an outline are holes, those inside a hole are none. Every new face is upright in
/// 32-bit UVs. Faces that fill gaps of a filled sheet need not be.
/// @param charts of the same faces, in which outlines are followed that name one
/// @param drawn nodes of outlines that were drawn before
/// @throws InputError more nodes would be drawn than require_few_outlines allows
Overlay draw_outlines(const FlatSheet& sheet, std::vector<DrawnOutline> outlines,
                      const std::vector<FlatSheet>& charts = {}, double drawn = 0.0);

}  // namespace koebe
