// The part of a surface that stays when a pattern is lifted, and the result made of it.
#pragma once

#include "lift/lift.h"
#include "lift/overlay.h"
#include "lift/raised.h"

#include <optional>
#include <vector>

namespace koebe {

struct KeptSheet {
    Vertices vertices, normals;
    Triangles triangles;
    std::vector<Complex> uv;
    std::vector<Index> original, patch;
    std::vector<Index> face;  // the surface's face of each
};

/// Keeps some faces of an overlay, and their vertices in their order.
/// @param keep (F) @param original_count vertices of the surface: the overlay has them first
KeptSheet kept_faces(const Overlay& overlay, const std::vector<char>& keep, Index original_count);

/// The sheet with its outlines at a height, or as it is.
RaisedSheet raised_sheet(const KeptSheet& sheet, const std::optional<double>& height);

/// Puts the raised sheet into the result.
/// @throws InputError faces would turn over (elements: the surface's faces)
void finish_sheet(const KeptSheet& sheet, RaisedSheet raised, const LiftOptions& options, LiftResult& result);

/// Puts the solid of the raised sheet and the sheet into the result.
/// @throws InputError faces would turn over, or the pattern is sunk through the solid; SolverError it is not closed
void finish_solid(const KeptSheet& sheet, const RaisedSheet& raised, const LiftOptions& options, LiftResult& result);

/// Tells the result's `face` and `weights`.
/// @param vertices, triangles of the surface as they came in @param source (V) vertex of the sheet for each vertex of
/// the raised sheet @param outer number of its faces
void tell_places(const KeptSheet& sheet, const Vertices& vertices, const Triangles& triangles,
                 const std::vector<Index>& source, std::size_t outer, LiftResult& result);

}  // namespace koebe
