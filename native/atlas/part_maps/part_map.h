// The conformal map of a part, and its texel densities as a disk or as a tube.
#pragma once

#include "circles/circle.h"
#include "execution/execution.h"
#include "part_maps/part_mesh.h"
#include "part_maps/texel_evenness.h"

#include <vector>

namespace koebe {

enum class PartKind { disk, tube, cone };

const char* to_string(PartKind kind) noexcept;

/// A map into the unit disk. One loop lies on the unit circle. A Moebius map has made its texels most even.
struct PartMap {
    VectorXcd positions;     ///< (V)
    VectorXcd strip;         ///< (V) for measured parts with two loops: log z, the imaginary part up to whole turns
    VectorXcd centers;       ///< (F) centres of the faces' images
    VectorXd u;              ///< (F) 1/2 log(UV area / area), smoothed; lost faces have the least value
    std::vector<char> lost;  ///< (F) 1: lost in rounding
    std::vector<Circle> circles;  ///< circles of the loops, in the order of the surface's loops
    int outer = 0;                ///< the loop on the unit circle
    bool measured = true;         ///< false: restricted from the map of a larger part
    double lost_area = 0.0;

    PartKind kind = PartKind::disk;  ///< the kind with the most even texels
    double overflow = 0.0;           ///< overflow of that kind, in area times u
    double from = 0.0;               ///< the lower end of its window
    double disk_overflow = 0.0;      ///< overflow as a disk
    double tube_overflow = -1.0;     ///< overflow as a tube; -1: not two loops
    double off_round = 0.0;          ///< restricted maps: the largest deviation of a loop from its circle, in radii
};

/// Maps a part: with two loops by the annulus map, otherwise by uniformize. Then moves it to its best pole
/// (even_pole.h). Faces of a disk may be turned over, because this map only judges the part.
/// @param purpose judging: the circles of three loops and more may be off by a thousandth of the disk
/// @throws SolverError, Cancelled
PartMap map_part(const PartMesh& part, MapPurpose purpose, ExecutionContext& context);

/// Makes the map of a smaller part from the map of a larger part. Circles stay circles, so both maps are the same up to
/// a Moebius map. @param whole, map the larger part and its map @param part some of its faces
PartMap restricted_map(const PartMesh& whole, const PartMap& map, const PartMesh& part);

}  // namespace koebe
