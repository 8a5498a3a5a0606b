// Forecasts the maps of a part's pieces from the part's map, without making their meshes.
#pragma once

#include "part_maps/part_map.h"

#include <vector>

namespace koebe {

struct PieceForecast {
    double area = 0.0, overflow = 0.0, lost_area = 0.0;  ///< as in PartMap
    double off_round = 0.0;                              ///< the largest deviation of a loop from its circle, in radii
};

/// Circles stay circles, so the part's map is the piece's map up to a Moebius map. Each piece is judged as a disk: its
/// outer loop on the unit circle, at the even_pole of some of its faces. A piece with two loops is also judged as a
/// tube.
/// @param piece (F) the piece of each face, from 0 to count, connected by edges; -1: in no piece
std::vector<PieceForecast> forecast_pieces(const PartMesh& part, const PartMap& map, const std::vector<Index>& piece,
                                           Index count);

}  // namespace koebe
