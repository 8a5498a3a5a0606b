// What uneven texel density costs.
#pragma once

#include "core/types.h"

#include <vector>

namespace koebe {

/// Texel densities within this factor count as even: log 3, in u = 1/2 log(UV area / area).
inline constexpr double factor_three = 1.0986122886681098;

/// What a face costs at most, in u: its area is lost to the artist.
inline constexpr double lost_cost = 6.0;

/// What a part is judged by: a little less, so that with rounding and the spread between neighbours all is within it.
inline constexpr double even_range = 0.8 * factor_three;

struct Evenness {
    double overflow =
        0.0;            ///< sum of area times the distance of u from [from, from + even_range], at most lost_cost each
    double from = 0.0;  ///< the best window's lower end; where there is a choice, its middle
    double inside = 0.0;  ///< area within the window
};

/// The window of least overflow. Sorted once, its ends move to where as much area lies below as above.
/// @param u (F) @param areas (F)
/// @param lost (F) 1: the face has no area in the map. It costs lost_cost wherever the window lies; empty: none is lost
Evenness evenness(const VectorXd& u, const VectorXd& areas, const std::vector<char>& lost = {});

/// About the same overflow by a histogram, without sorting: to compare many maps of one part.
double rough_overflow(const VectorXd& u, const VectorXd& areas);

}  // namespace koebe
