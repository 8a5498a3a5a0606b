// Finds the Moebius map that makes the texels of a part most even.
#pragma once

#include "circles/circle.h"
#include "core/types.h"

#include <vector>

namespace koebe {

struct PartMap;

/// A sample of the faces of a map.
struct MapSample {
    VectorXcd centers;  ///< centres of the faces' images, in the unit disk
    VectorXd u, areas;
};

/// A Moebius map. First, if `turned` names a loop, inside and outside of its circle change places, and it becomes the
/// unit circle. Then the point `a` goes to 0.
struct EvenPole {
    Complex a = 0.0;
    int turned = -1;
    double overflow = 0.0;  ///< overflow of the moved sample
};

/// The Moebius map M of least overflow. Its pole lies beyond the unit circle or in a large hole. M adds log |M'| to u.
/// Searches on a grid of poles, and refines the best by halving steps.
/// @param circles circles of the loops @param outer the loop on the unit circle
EvenPole even_pole(const MapSample& sample, const std::vector<Circle>& circles, int outer);

/// The sample moved by the Moebius map `pole`.
MapSample moved(const MapSample& sample, const std::vector<Circle>& circles, const EvenPole& pole);

/// Moves a map by the even_pole of about 350 of its faces. Faces lost in rounding do not count.
/// @param areas (F) @param map moved in place: positions, centers, u, outer
void move_to_even_pole(const VectorXd& areas, PartMap& map);

}  // namespace koebe
