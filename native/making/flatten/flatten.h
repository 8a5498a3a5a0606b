// Flat patterns: a surface cut into parts that lie flat in real size, on pages.
#pragma once

#include "core/api.h"
#include "core/page.h"
#include "core/types.h"
#include "execution/execution.h"
#include "flatten/pattern.h"
#include "part_maps/part_map.h"
#include "quality/report.h"

#include <optional>
#include <string>
#include <vector>

namespace koebe {

struct FlattenOptions {
    LengthUnit units = LengthUnit::mm;  ///< of the mesh
    std::string page = "A4";            ///< as page_named has it
    double allowance = 0.0;             ///< mm round each piece
    /// Of a part, as in PartsOptions. None: a surface that is bent at few vertices gets the shortest cuts, if they make
    /// it lie true to size. Any other surface gets the cuts of parts.
    std::optional<double> price = {};
    double darts = 0.05;              ///< as in PartsOptions
    std::vector<Index> polygon = {};  ///< (F) faces with one number stay together; empty: no faces do
    int threads = 0;                  ///< at most; 0: as many as the machine has
};

/// By how much lengths in a face differ from lengths on the surface, in per cent, in the direction of the largest
/// difference.
struct Stretch {
    double mean = 0.0;  ///< over the area
    double max = 0.0;   ///< of all faces that are thick enough to have angles
};

struct PatternPiece {
    PartKind kind = PartKind::disk;
    std::vector<Index> faces;          ///< rising
    double width = 0.0, height = 0.0;  ///< mm, as it lies, without the allowance
    double outline = 0.0;              ///< mm, the length of all its loops
    int darts = 0;
    int sheet = 0;  ///< from 0
    Stretch stretch;
};

/// A cut, numbered from 1 as the labels on its sides are.
struct PatternSeam {
    double length = 0.0;  ///< mm on the surface
    bool closed = false;
    std::vector<int> pieces;      ///< on its sides, from 1; one piece twice for a dart or a slit
    std::vector<double> lengths;  ///< mm of each side, flat
};

/// Its UVs are millimetres on the sheet of each face's piece.
struct FlattenResult : CornerMapReport {
    std::vector<Index> part;  ///< (F) piece of each face from 0; -1: in none
    std::vector<PatternPiece> pieces;
    std::vector<PatternSeam> seams;
    Stretch stretch;
    double cut_length = 0.0;  ///< mm on the surface, of all seams
    Index darts = 0;
    Pattern pattern;
};

/// Cuts a surface into parts. Lays each part flat, as true to size as possible (E = 1, all loops free). Puts the parts
/// on pages in real size. Every piece is one to one, and pieces do not overlap, not even with their allowances. Pieces
/// that fit on a page share pages; larger ones lie on sheets of several pages whose frames meet. Pieces under a tenth
/// of a millimetre are left out, at most a hundredth of the area.
///
/// @param vertices (V, 3) @param triangles (F, 3) never changed
/// @throws InputError an option; pieces that are too small, too large, or need too many pages; TopologyError;
/// SolverError a piece that is not one to one, or whose allowance cannot be drawn; Cancelled
KOEBE_API FlattenResult flatten(const Vertices& vertices, const Triangles& triangles, const FlattenOptions& options,
                                ExecutionContext& context);

}  // namespace koebe
