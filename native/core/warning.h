// What to watch out for in a result that is there all the same.
#pragma once

#include "core/api.h"
#include "core/elements.h"
#include "core/types.h"

#include <string>
#include <vector>

namespace koebe {

enum class WarningKind {
    collapsed_faces,   ///< faces of the file with fewer than three different vertices, passed over; elements: faces
    unused_vertices,   ///< vertices of no face, put at the centre; elements: vertices
    reoriented_faces,  ///< turned to the orientation of the others; elements: faces
    thin_faces,        ///< so thin that rounding shows in the map
    coarse_mesh,       ///< too few vertices between the loops
    no_flux,           ///< boundary vertices without flux, kept apart by a least distance
    not_converged,     ///< the iteration, or the flow, ended before its tolerance
    no_circles,        ///< the iteration led to none; those that are there fit a map of low angle error
    lost_circles,      ///< too deep for rounding, or of too coarse a mesh; elements: loops
    shrunk_circles,    ///< made smaller, as they met another; elements: loops
    replaced_circles,  ///< others than the iteration's, on which no face turns over; elements: loops
    flaps,             ///< parts that hang on a loop by one edge; elements: their faces
    off_circle,        ///< vertices taken off their circle; elements: vertices
    below_resolution,  ///< a region too small for 32-bit UVs, with flipped faces in it; elements: its faces
    flipped,           ///< faces that could not be turned back; elements: faces
    not_one_to_one,    ///< a promise that does not hold; elements: the flipped faces among it
    out_of_place,      ///< a vertex that could not be brought to 0 without turning faces over; elements: it
    packing,           ///< the Ricci baseline: its circle packing changes edge lengths
    closing_gap,       ///< the Ricci baseline: holes do not close exactly
    flow_flips,        ///< the Ricci baseline: flips of the flow's own map
    no_hole,           ///< nothing to fill but the outer boundary
    not_fitted,        ///< of a transfer: holes that were not bent onto each other; elements: loops of the source
    replaced_uvs,      ///< texture coordinates of the file gave way to those of the map
    not_kept,          ///< what the file holds and the one that is written does not
    cut,               ///< the surface was cut in the UVs, as the report's cuts say; elements: vertices of the cuts
    pieces,            ///< several pieces, each with a map of its own
    left_out,          ///< faces without a place of their own in the map; elements: they
    not_even,          ///< left conformal, as no map that is more even was found; elements: faces of such parts
    lost_area,         ///< more of the surface than is allowed has no area in the UVs; elements: its faces
    not_mapped,        ///< faces of pieces that have no map; elements: they. The last of the kinds
};

/// As in the JSON report: the enumerator's name.
KOEBE_API const char* to_string(WarningKind kind) noexcept;
/// What the elements of a warning are.
KOEBE_API ElementKind elements_of(WarningKind kind) noexcept;

struct Warning {
    WarningKind kind;
    std::string sentence;              ///< without a full stop
    std::vector<Index> elements = {};  ///< rising; loops by their place in the report
    std::string advice = {};           ///< one more sentence, or none

    /// The sentence, the first of the elements, the advice.
    std::string text() const;
    bool operator==(const Warning&) const = default;
};

}  // namespace koebe
