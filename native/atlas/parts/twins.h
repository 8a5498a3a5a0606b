// Parts that are copies or mirror images of other parts: laid alike, or on one place in the UVs.
#pragma once

#include "flat/congruence.h"

#include <optional>
#include <vector>

namespace koebe {

/// The twins among parts: copies alone, and copies and mirror images. A part that has both is a twin of its copy.
struct Twins {
    std::vector<std::optional<Twin>> copies, all;  ///< (parts)
};

/// Of each part the part that it is a twin of, if there is one. That part is no twin itself. A twin gets the other
/// part's map. Polygons, cuts, darts and wanted sizes correspond. A rotation, or a reflection for mirror images, takes
/// the vertices to each other, to a thousandth of the part and 2e-4 of the root of the whole's area. All faces of the
/// twin are upright on the other part's map, and its angles there are no worse than on its own map, but for a tenth of
/// a degree. Diagonals of polygons need not correspond.
/// @param parts with maps that are one to one; others have no twins
Twins find_twins(std::vector<FlatPart>& parts);

/// Whether all faces of a twin lie there as 32-bit floats as they should: turned over if it is mirrored, else upright.
/// @param uv (V, 2) of the twin
bool lies_as_twin(const FlatPart& part, const Twin& twin, const PlanarPoints& uv);

}  // namespace koebe
