// Puts the image of a loop onto its circle without changing its order.
#pragma once

#include "circles/circle.h"

namespace koebe {

/// Moves points radially onto the circle, then along it as little as possible until they run round once in order. If
/// the angle of a point is less than the angle of an earlier point, the two are pooled, a least distance apart
/// (isotonic regression, Ayer et al. 1955). With hardly any flux an image turns back on itself, and the interior could
/// not follow such an image.
/// @param points (n) image of a loop in order, n >= 3 @param turn +1 counter-clockwise (the outer loop), -1 clockwise
/// @param least (n) radians from each point to the next, sum below 2 pi; empty: 1e-3 of the mean
VectorXcd project_onto_circle(const Circle& circle, const VectorXcd& points, int turn, const VectorXd& least = {});

/// Whether points run once round a place in their order. @param arms (n) from that place to the points, none of them 0
/// @param turn +1 counter-clockwise, -1 clockwise
bool run_once_round(const VectorXcd& arms, int turn);

/// Whether a point is farther from a circle than circle_tolerance (on_circle.h), or is not finite.
bool is_off_circle(const Circle& circle, Complex point);

}  // namespace koebe
