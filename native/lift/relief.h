// Heights of a pattern that is raised from a surface.
#pragma once

#include "lift/overlay.h"

namespace koebe {

/// For each outline a second one inside it, where the ramp ends.
/// @param share of the way to the outline's middle that the ramp takes, between 0 and 1
std::vector<Outline> with_inner_outlines(const FlatSheet& sheet, const std::vector<Outline>& outlines, double share);

/// (V) Heights of the overlay's vertices: 0 outside the outlines, 1 inside the inner ones, between them by the distances
/// in space from both.
VectorXd relief_heights(const Overlay& overlay);

}  // namespace koebe
