// Loop vertices that are not on their circles: told in one way by all maps.
#pragma once

#include "circles/circle.h"
#include "core/warning.h"

#include <vector>

namespace koebe {

/// Whether a point of the unit disk is farther from a circle than circle_tolerance, or nowhere.
bool is_off_circle(const Circle& circle, Complex point);

/// Adds the warning that names them, if there are any. @param vertices of the input, in any order, each once or more
void warn_off_circle(std::vector<Index> vertices, std::vector<Warning>& warnings);

}  // namespace koebe
