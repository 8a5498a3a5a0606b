// Parts that were decided on a coarse surface, made of the fine one.
#pragma once

#include "flat/flat_part.h"
#include "proxies/carried_net.h"
#include "splitting/splitting.h"

#include <vector>

namespace koebe {

/// The faces of each part, ascending: the fine surface cut only where two parts meet, not at their darts and slits.
/// @return empty if the fine pieces do not correspond to the parts
std::vector<std::vector<Index>> carried_faces(const Proxy& proxy, const std::vector<FlatPart>& parts,
                                              const ExecutionContext& context);

/// Cuts the fine surface along the net of the parts, with their darts and slits. Each piece takes its place in the
/// plane from its relaxed part: its edges have, in the mean, the courses that the part's map would give them. If it is
/// not one to one there, also as stored, it has no places (is_near is false).
/// @param parts they name faces and vertices of the coarse surface
/// @return for each part its piece, with numbers of the fine surface; empty if they do not correspond
std::vector<FlatPart> carried_parts(const Proxy& proxy, const std::vector<FlatPart>& parts, int threads,
                                    ExecutionContext& context);

}  // namespace koebe
