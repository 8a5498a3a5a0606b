// Any mesh: cut in the UVs until each piece can be mapped, and the maps side by side.
#pragma once

#include "core/api.h"
#include "cut/open_surface.h"
#include "execution/execution.h"
#include "pipeline/result.h"

#include <vector>

namespace koebe {

struct MappedPiece {
    std::vector<Index> faces;  ///< of the input, rising
    /// All numbers in it are the input's. Its UVs are those of the piece's own unit disk, in no order that is promised.
    UniformizeResult map;
    Circle place;        ///< of that disk in the square [-1, 1]^2; u = (1 + x) / 2, v = (1 + y) / 2
    bool mapped = true;  ///< false: no map could be made, all its corners lie on one point
};

/// Converged are all pieces; distortion is that of all, where they lie in the end; warnings of one kind are together.
/// The UVs lie in [0, 1]^2; faces are turned to the orientation of their piece.
struct CutUniformizeResult : CornerMapReport {
    Method method = Method::gk;
    Engine engine = Engine::condensed;
    std::vector<MappedPiece> pieces;
    std::vector<SurfaceCut> cuts;
    std::vector<LeftOutFace> left_out;  ///< these are drawn where the face is that they are like; not in any figure
    int handles = 0;                    ///< that were cut
};

/// Opens, cuts and splits whatever `uniformize` refuses (cut/open_surface.h), maps every piece, and packs the disks
/// into the unit square, each sized by its area.
///
/// Vertices that the options name (outer, center, point) matter for the first piece where they can be what is asked;
/// the other pieces choose by themselves.
/// @param vertices (V, 3) positions, any unit @param triangles (F, 3) indices in range
/// @param polygon (F) as in OpenOptions, or empty
/// @throws InputError arrays that are no mesh, a named vertex that can nowhere be what is asked; SolverError, Cancelled
KOEBE_API CutUniformizeResult uniformize_with_cuts(const Vertices& vertices, const Triangles& triangles,
                                                   const std::vector<Index>& polygon, const UniformizeOptions& options,
                                                   ExecutionContext& context);

/// The same without progress, never cancelled.
CutUniformizeResult uniformize_with_cuts(const Vertices& vertices, const Triangles& triangles,
                                         const std::vector<Index>& polygon = {}, const UniformizeOptions& options = {});

}  // namespace koebe
