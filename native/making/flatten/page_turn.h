// The turn in which a piece fits a page.
#pragma once

#include "core/types.h"

#include <optional>

namespace koebe {

constexpr double page_slack = 1e-9;  ///< of a page's side: a piece that is larger by this fits

/// A turn (of absolute value 1) in which the points lie in a rectangle along the axes, the one with the most room among
/// those where the room or the supporting corners change. The rectangle of a turning convex polygon has sides d cos(t -
/// a) between the turns where a side of the polygon lies along an axis [Toussaint 1983]. So if any turn fits, one of
/// these fits: such a turn, or a root of d cos(t - a) = width or height.
/// @param points (V, 2) @return no value if no turn fits
std::optional<Complex> turn_into(const PlanarPoints& points, double width, double height);

}  // namespace koebe
