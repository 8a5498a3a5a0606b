// What uneven texel density costs.
#pragma once

#include "core/types.h"

namespace koebe {

/// Texel densities within this factor count as even: log 3, in u = 1/2 log(UV area / area).
inline constexpr double factor_three = 1.0986122886681098;

/// What a part is judged by: a little less, so that with rounding and the spread between neighbours all is within it.
inline constexpr double even_range = 0.8 * factor_three;

struct Evenness {
    double overflow = 0.0;  ///< sum of area times the distance of u from [from, from + even_range], at most 6 each
    double from = 0.0;      ///< the best window's lower end; where there is a choice, its middle
    double inside = 0.0;    ///< area within the window
};

/// The window of least overflow. Sorted once, its ends move to where as much area lies below as above.
/// @param u (F) @param areas (F)
Evenness evenness(const VectorXd& u, const VectorXd& areas);

/// About the same overflow by a histogram, without sorting: to compare many maps of one part.
double rough_overflow(const VectorXd& u, const VectorXd& areas);

}  // namespace koebe
