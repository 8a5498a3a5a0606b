// The conformal map of a part, and the densities of what it can be drawn as.
#pragma once

#include "circles/circle.h"
#include "evenness/evenness.h"
#include "evenness/part_mesh.h"
#include "execution/execution.h"

#include <array>
#include <vector>

namespace koebe {

enum class PartKind { disk, tube, cone };

const char* to_string(PartKind kind) noexcept;

/// A map into the unit disk, one loop on the unit circle, moved to the most even texels.
struct PartMap {
    VectorXcd positions;          ///< (V)
    VectorXcd strip;              ///< (V) of two loops, if measured: log z, the imaginary part up to whole turns
    VectorXcd centers;            ///< (F) of the faces' images
    VectorXd u;                   ///< (F) 1/2 log(UV area / area), smoothed; where it is lost in rounding, the least
    std::vector<char> lost;       ///< (F) 1: lost in rounding
    std::vector<Circle> circles;  ///< of the loops, in the order of the surface's loops
    int outer = 0;                ///< the loop on the unit circle
    bool measured = true;         ///< false: restricted from the map of a larger part
    double lost_area = 0.0;

    PartKind kind = PartKind::disk;  ///< the most even of what it can be
    double overflow = 0.0;           ///< of that kind, in area times u
    double from = 0.0;               ///< the lower end of its window
    double disk_overflow = 0.0;      ///< of the disk
    double tube_overflow = -1.0;     ///< of the tube, of two loops
    double off_round = 0.0;          ///< of a restricted map: the largest deviation of a loop from its circle, in radii
};

/// Maps a part: two loops by the annulus map, others by uniformize; then the best pole (as_even_as_can_be). Faces of a
/// disk may be turned over: here it is only judged.
/// @throws SolverError, Cancelled
PartMap map_part(const PartMesh& part, ExecutionContext& context);

/// What the map of a larger part says of the map of a smaller one: circles stay circles, so up to a Moebius map it is
/// the same. @param whole, map the larger part and its map @param part some of its faces
PartMap restricted_map(const PartMesh& whole, const PartMap& map, const PartMesh& part);

}  // namespace koebe
