// The parts of a mesh in their places.
#pragma once

#include "cut/open_surface.h"
#include "flat/divided_faces.h"
#include "flat/flat_part.h"
#include "parts/parts.h"
#include "quality/report.h"

#include <vector>

namespace koebe {

/// The corners of a face are in the order in which the face was mapped. For the faces `reoriented` this is the reverse
/// of the input's order.
struct PartsLayout {
    Vertices vertices;        ///< the input's vertices, scaled so that all areas sum to 1
    Triangles triangles;      ///< (F, 3) faces of the input, turned to one orientation in each piece
    PlanarPoints uv;          ///< (3F, 2) in [0, 1]^2, or in the places of the parts
    std::vector<Index> part;  ///< (F); -1: a face in no part: it is degenerate, or doubles another face
    std::vector<PartReport> parts;
    std::vector<Index> reoriented;  ///< faces that were turned to the orientation of the others
    std::vector<Index> turned;      ///< faces whose corners run backwards: `reoriented` or in a mirrored part, not both
    Index overlaps = 0;             ///< number of parts whose boundary crosses itself
    std::vector<Index> crossing;    ///< faces of these parts
    double slit_length = 0.0, dart_length = 0.0;
    Index darts = 0;
    int handles_cut = 0;
    double even = 0.0;            ///< the E of all parts but the parts of `not_even`
    std::vector<Index> not_even;  ///< faces whose parts stayed conformal
    double maps = 0.0;            ///< number of faces mapped, over the faces of the mesh
    double noise = 0.0;           ///< up to which planar regions are flat (PlanarRegions); 0: up to rounding
};

/// The parts before they are packed, in the unit of the layout's vertices.
struct FlatMesh {
    PartsLayout layout;  ///< what is known before the parts have their places
    std::vector<FlatPart> parts;
    std::vector<LeftOutFace> left_out;
    std::vector<Index> polygon;  ///< (F') of the faces in the parts
    DividedFaces divided;  ///< the faces in the parts; nothing is divided: they are the input's, and this is empty
    Triangles undivided;   ///< (F, 3) the input's faces; empty as well
    StageSeconds seconds;  ///< topology and iterate
};

/// Sums the parts' slits and darts for the layout.
void sum_cuts(FlatMesh& mesh);

/// Divided faces are whole again.
/// @param places (V, 2) of each part's vertices, the UVs of the layout
/// @param mirrored of each part 1 if it lies there with its back to the front; empty: no part does
PartsLayout layout_at(FlatMesh mesh, const std::vector<PlanarPoints>& places, const std::vector<char>& mirrored = {});

/// (3F, 2) of the input's corners, in their order.
PlanarPoints uv_of_input(const PartsLayout& layout, const Triangles& input);

/// The distortion of some faces. Each corner counts as a vertex of its own. @param uv (3F, 2) in [0, 1]^2
ComputedDistortion distortion_of_parts(const PartsLayout& layout, const PlanarPoints& uv,
                                       const std::vector<Index>& faces);

}  // namespace koebe
