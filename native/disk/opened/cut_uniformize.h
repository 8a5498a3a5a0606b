// Maps any mesh: cuts it in the UVs until each piece can be mapped, and puts the maps side by side.
#pragma once

#include "core/api.h"
#include "cut/open_surface.h"
#include "execution/execution.h"
#include "pipeline/result.h"

#include <vector>

namespace koebe {

struct MappedPiece {
    std::vector<Index> faces;  ///< of the input, ascending
    /// All numbers in the result are the input's. Its UVs are in the piece's own unit disk, in no particular order.
    UniformizeResult map;
    Circle place;        ///< of the piece's disk in the square [-1, 1]^2; u = (1 + x) / 2, v = (1 + y) / 2
    bool mapped = true;  ///< false: the piece has no map, and all its corners lie on one point
};

/// `converged` is true if all pieces have converged. Distortion is measured over all pieces in their final places.
/// Warnings are merged by kind. The UVs lie in [0, 1]^2. Faces are turned to the orientation of their piece.
struct CutUniformizeResult : CornerMapReport {
    Method method = Method::gk;
    Engine engine = Engine::condensed;
    std::vector<MappedPiece> pieces;
    std::vector<SurfaceCut> cuts;
    std::vector<LeftOutFace> left_out;  ///< drawn over the face that they repeat; they count in no figure
    int handles = 0;                    ///< number of handles cut
};

/// Opens, cuts and splits every mesh that `uniformize` refuses (cut/open_surface.h), maps every piece, and packs the
/// disks into the unit square. The size of a disk follows the area of its piece.
///
/// Vertices that the options name (outer, center, point) apply to the first piece where they are possible; the other
/// pieces choose their own.
/// @param vertices (V, 3) positions, any unit @param triangles (F, 3) indices in range
/// @param polygon (F) as in OpenOptions, or empty
/// @throws InputError the arrays are not a mesh, or a named vertex is possible in no piece; SolverError, Cancelled
KOEBE_API CutUniformizeResult uniformize_with_cuts(const Vertices& vertices, const Triangles& triangles,
                                                   const std::vector<Index>& polygon, const UniformizeOptions& options,
                                                   ExecutionContext& context);

/// Maps without progress reports or cancelling.
CutUniformizeResult uniformize_with_cuts(const Vertices& vertices, const Triangles& triangles,
                                         const std::vector<Index>& polygon = {}, const UniformizeOptions& options = {});

}  // namespace koebe
