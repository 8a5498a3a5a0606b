// The material between openings: where it is thinner than asked for.
#pragma once

#include "execution/execution.h"
#include "lift/flat_sheet.h"
#include "lift/overlay.h"

#include <optional>
#include <vector>

namespace koebe {

struct ThinBridges {
    Index count = 0;                   ///< pairs of openings
    std::optional<double> thinnest{};  ///< of these
    std::vector<Index> faces{};        ///< of the surface, where each pair is nearest: ascending
};

/// Pairs of openings, or of an opening and a hole or rim of the surface, with less material between than a width. Of
/// each pair the nearest points are taken, and the way between them over the surface that a plane along its normals
/// cuts out. In a plane this is their distance. A bridge counts if it is thinner by more than a twentieth, as outlines
/// are moved onto vertices. A pair does not count if an outline meets the rim, and no opening is beside itself.
/// @param sheet that the overlay was made of @param keep (F) the faces that are not cut out
/// @throws InputError the width is more than a few times that of the openings: too many pairs
ThinBridges thin_bridges(const FlatSheet& sheet, const Overlay& overlay, const std::vector<char>& keep, double width,
                         const ExecutionContext& context);

}  // namespace koebe
