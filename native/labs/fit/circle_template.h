// A template: the circle domain that a surface is to be mapped to.
#pragma once

#include "bending/template_rim.h"
#include "circles/circle.h"

#include <string>
#include <vector>

namespace koebe {

struct CircleTemplate {
    std::vector<Circle> circles;          ///< of the holes, inside the unit disk and apart
    std::vector<std::string> names = {};  ///< of the holes; empty: no names
    std::vector<int> loops = {};          ///< for each hole its loop in Surface::loops; empty: those that fit best
    TemplateRim outer = {};               ///< of the unit circle
    std::vector<TemplateRim> rims = {};   ///< of the holes; empty: all rotate
};

/// Disk units: the least radius of a template's circle, and the least gap between two circles. 32-bit UVs resolve less,
/// but no face fits in between.
inline constexpr double least_template_gap = 1e-6;

/// Checks the template by itself.
/// @throws InputError numbers that are not finite, a circle that is too small, leaves the unit disk or meets another
/// (these circles listed, counted from 0), lists of different lengths
void require_feasible(const CircleTemplate& wanted);

}  // namespace koebe
