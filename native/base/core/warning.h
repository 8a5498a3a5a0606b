// Warnings about a result.
#pragma once

#include "core/api.h"
#include "core/elements.h"
#include "core/types.h"

#include <string>
#include <vector>

namespace koebe {

enum class WarningKind {
    collapsed_faces,   ///< faces of the file with fewer than three different vertices, left out; elements: faces
    unused_vertices,   ///< vertices of no face, put at the centre; elements: vertices
    reoriented_faces,  ///< turned to the orientation of the others; elements: faces
    thin_faces,        ///< so thin that rounding shows in the map
    coarse_mesh,       ///< too few vertices between the loops
    no_flux,           ///< boundary vertices without flux, kept apart by a least distance
    not_converged,     ///< the iteration, or the flow, ended before it reached its tolerance
    no_circles,        ///< the iteration found no circles; the circles given fit a map of low angle error
    lost_circles,      ///< circles lost in rounding, or to a coarse mesh; elements: loops
    shrunk_circles,    ///< circles made smaller because they met another circle; elements: loops
    replaced_circles,  ///< other circles than the iteration's, on which no face turns over; elements: loops
    flaps,             ///< parts that hang on a loop by one edge; elements: their faces
    off_circle,        ///< vertices taken off their circle; elements: vertices
    below_resolution,  ///< a region too small for 32-bit UVs, with flipped faces in it; elements: its faces
    flipped,           ///< faces that could not be turned back; elements: faces
    not_one_to_one,    ///< a promise that does not hold; elements: the flipped faces among others
    out_of_place,      ///< a vertex that could not move to 0 without turning faces over; elements: that vertex
    packing,           ///< the Ricci baseline: its circle packing changes edge lengths
    closing_gap,       ///< the Ricci baseline: holes do not close exactly
    flow_flips,        ///< the Ricci baseline: faces flipped in the flow's own map
    no_hole,           ///< the surface has no hole besides the outer boundary
    not_fitted,        ///< of a transfer: holes that could not be bent onto each other; elements: loops of the source
    replaced_uvs,      ///< the map's texture coordinates replaced those of the file
    not_kept,          ///< contents of the input file that the written file does not hold
    cut,               ///< the surface was cut in the UVs (the report lists the cuts); elements: vertices of the cuts
    pieces,            ///< several pieces, each with a map of its own
    left_out,          ///< faces without a place of their own in the map; elements: these faces
    not_even,          ///< parts left conformal, as no map that is more even was found; elements: their faces
    not_enclosed,      ///< the circles have no proved bounds, but the capacities have
    crossings,         ///< distant places of a lifted pattern meet; elements: the surface's faces there
    thin_bridges,      ///< less material between two openings than was asked for; elements: the surface's faces there
    lost_area,         ///< more area than allowed has no area in the UVs; elements: the faces without area
    concave_polygons,  ///< convex on the surface, but not in the UVs; elements: faces
    not_mapped,        ///< faces of pieces without a map; elements: these faces
    coincident,  ///< vertices of rims at the place of another one (io/welding.h); elements: vertices. Must stay the
                 ///< last kind
};

/// The enumerator's name, as in the JSON report.
KOEBE_API const char* to_string(WarningKind kind) noexcept;
/// The kind of elements that a warning lists.
KOEBE_API ElementKind elements_of(WarningKind kind) noexcept;

struct Warning {
    WarningKind kind;
    std::string sentence;              ///< without a full stop
    std::vector<Index> elements = {};  ///< ascending; loops by their place in the report
    std::string advice = {};           ///< a further sentence, or empty

    /// The sentence, then the first elements, then the advice.
    std::string text() const;
    bool operator==(const Warning&) const = default;
};

}  // namespace koebe
