// What the map of a part says of its pieces, without their meshes.
#pragma once

#include "evenness/part_map.h"

#include <vector>

namespace koebe {

struct PieceForecast {
    double area = 0.0, overflow = 0.0, lost_area = 0.0;  ///< as of PartMap
    double off_round = 0.0;                              ///< the largest deviation of a loop from its circle, in radii
};

/// Circles stay circles, so up to a Moebius map a piece's map is the part's. Each piece is judged as a disk, its outer
/// loop on the unit circle, at the even_pole of some of its faces, and of two loops as a tube.
/// @param piece (F) of the part's faces, from 0 to count, each connected by edges; -1: in none
std::vector<PieceForecast> forecast_pieces(const PartMesh& part, const PartMap& map, const std::vector<Index>& piece,
                                           Index count);

}  // namespace koebe
