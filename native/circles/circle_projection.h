// Puts the image of a loop onto its circle without changing its order.
#pragma once

#include "circles/circle.h"

namespace koebe {

/// Radially onto the circle, and then along it as little as makes the points run round once in their order: angles
/// that come too early for those before them are pooled with these (isotonic regression, Ayer et al. 1955) at a least
/// distance. Where hardly any flux runs the image turns back on itself; no interior could follow that.
/// @param points (n) image of a loop in order, n >= 3 @param turn +1 counter-clockwise (the outer loop), -1 clockwise
/// @param least (n) radians from each point to the next, of sum below 2 pi; 1e-3 of the mean if it is empty
VectorXcd project_onto_circle(const Circle& circle, const VectorXcd& points, int turn, const VectorXd& least = {});

/// Whether points run once round a place, in their order. @param arms (n) from that place, none 0
/// @param turn +1 counter-clockwise, -1 clockwise
bool run_once_round(const VectorXcd& arms, int turn);

/// Whether a point of the unit disk is farther from a circle than circle_tolerance, or nowhere.
bool is_off_circle(const Circle& circle, Complex point);

}  // namespace koebe
