// The Moebius map of a part that makes its texels most even.
#pragma once

#include "circles/circle.h"
#include "core/types.h"

#include <vector>

namespace koebe {

struct PartMap;

/// Some faces of a map.
struct MapSample {
    VectorXcd centers;  ///< of the faces' images, in the unit disk
    VectorXd u, areas;
};

/// A Moebius map of the unit disk: first, if `turned` names a loop, its circle goes onto the unit circle, inside out;
/// then the point `a` goes to 0.
struct EvenPole {
    Complex a = 0.0;
    int turned = -1;
    double overflow = 0.0;  ///< of the sample
};

/// The map of least overflow. The pole lies beyond the unit circle or in a large hole. u changes by log |M'|. Searched
/// on a grid of poles and refined by halving steps.
/// @param circles of the loops @param outer the one that is the unit circle
EvenPole even_pole(const MapSample& sample, const std::vector<Circle>& circles, int outer);

/// The sample moved by it.
MapSample moved(const MapSample& sample, const std::vector<Circle>& circles, const EvenPole& pole);

/// Moves a map by the even_pole of some 350 of its faces; those lost in rounding do not count.
/// @param areas (F) @param map moved in place: positions, centers, u, outer
void move_to_even_pole(const VectorXd& areas, PartMap& map);

}  // namespace koebe
