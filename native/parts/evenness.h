// What uneven texel density costs.
#pragma once

#include "core/types.h"

namespace koebe {

/// Texel densities within this factor count as even: log 3, in u = 1/2 log(UV area / area).
inline constexpr double even_range = 1.0986122886681098;

struct Evenness {
    double overflow = 0.0;  ///< sum of area times the distance of u from [from, from + even_range], at most 6 each
    double from = 0.0;      ///< the best window's lower end; where there is a choice, its middle
    double inside = 0.0;    ///< area within the window
};

/// The window of least overflow. Sorted once, its ends move to where as much area lies below as above.
/// @param u (F) @param areas (F)
Evenness evenness(const VectorXd& u, const VectorXd& areas);

}  // namespace koebe
