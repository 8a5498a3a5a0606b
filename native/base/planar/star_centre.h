// Finds a place for a vertex among its neighbours where every face round it is upright and has its share of area.
#pragma once

#include "core/types.h"

#include <optional>
#include <vector>

namespace koebe {

/// The point x in the kernel of a star-shaped polygon that maximizes sum_i w_i log(area of the face x, p_i, p_i+1), a
/// concave function, by damped Newton steps (the weighted analytic centre of the kernel; Boyd and Vandenberghe 2004,
/// section 8.5.3). In a triangle the areas are then in proportion to the weights.
/// @param polygon counter-clockwise, at least 3 corners @param weights (n) positive
/// @param start a point of the kernel, if known
/// @return nothing if no point was found that leaves every face upright
std::optional<Complex> star_centre(const std::vector<Complex>& polygon, const std::vector<double>& weights,
                                   const std::optional<Complex>& start = {});

}  // namespace koebe
