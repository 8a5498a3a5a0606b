// Where parts may be joined again, or a slit closed.
#pragma once

#include "cost/costs.h"
#include "flat/flat_part.h"

#include <optional>
#include <set>
#include <vector>

namespace koebe {

/// The edges of a stretch, named by their vertices in the whole.
using BorderStretch = std::vector<EdgeEnds>;

struct Stitch {
    std::vector<BorderStretch> stretches;  ///< one, or one and its mirror image
    double saved = 0.0;                    ///< what the cut and the island cost
    double forecast = 0.0;                 ///< of what is won
};

/// The stitch that promises to win most, along a stretch of a border or of a slit; nothing if none may pay. On a
/// surface that is its own mirror image it has both stretches, or one that is its own image. Flat parts stay.
/// @param parts relaxed @param refused edges in the middle of stretches that did not pay
std::optional<Stitch> best_stitch(const std::vector<FlatPart>& parts, const ThroughPrice& price,
                                  const std::set<EdgeEnds>& refused);

/// The length of an edge on the surface. @param h one of its half-edges
double length_on_part(const FlatPart& part, Index h);

}  // namespace koebe
