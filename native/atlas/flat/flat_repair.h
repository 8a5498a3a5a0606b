// Repairs flat parts: faces that are turned over, loops that cross.
#pragma once

#include "execution/execution.h"
#include "flat/flat_part.h"

namespace koebe {

/// A map that is one to one, for any part. The longest loop is the outer loop.
PlanarPoints embedded_anew(const Vertices& vertices, const Surface& surface, const ExecutionContext& context);

/// Raises slivers that have no height in space either, such as faces at an edge without length, by rounding.
void raise_slivers(FlatPart& part);

/// Mends a part that overlaps itself by noise: moves corners of slivers that are turned over, and vertices of the
/// boundary that lie behind another edge of it, each time by at most the noise. Nothing changes if that does not help.
/// @param noise in the unit of the points
void mend_noise(FlatPart& part, double noise);

/// Turns flipped faces back where the part lies in its tile, for example the unit square. First the boundary is held.
/// If flips are left, all vertices move, as long as no loops cross.
/// @param uv (V, 2) in [0, 1]^2 or another tile, changed in place @return faces still flipped as 32-bit floats
Index repair_flips(const FlatPart& part, PlanarPoints& uv, const ExecutionContext& context);

/// If faces are turned over or loops cross, replaces the map by a map that is one to one from its start, in the same
/// box. The part becomes a disk, and less even. Nothing changes if the new map is no better.
/// @param uv (V, 2) in [0, 1]^2 or another tile, changed in place
void embed_safely(FlatPart& part, PlanarPoints& uv, ExecutionContext& context);

}  // namespace koebe
