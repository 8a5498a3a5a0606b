// A part laid into the plane: a disk, or a tube opened along a slit.
#pragma once

#include "execution/execution.h"
#include "splitting/splitting.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace koebe {

/// A flat part: a disk or a disk with holes, its slit open. Each part has its own unit of length in the plane.
struct FlatPart {
    std::vector<Index> faces;     ///< faces of the whole, in the order of the triangles
    std::vector<Index> original;  ///< (V) the vertex of the whole
    std::vector<Index> image;     ///< (V) the mirror image, a vertex of the whole; empty: the whole has no mirror
    Vertices vertices;            ///< (V, 3) scaled so that the whole surface has area 1
    Surface surface;              ///< with the slit open
    PlanarPoints points;  ///< (V, 2) scaled so that faces within the even window have their own area in the mean
    PartKind kind = PartKind::disk;
    std::vector<VertexLoop> loops;         ///< loops before the slit is opened, as vertices of the whole
    std::vector<std::vector<Index>> rims;  ///< the vertices of this part that each loop became
    std::vector<char> held;                ///< (V) 1 for vertices that stay on the circle or line of their rim
    std::vector<double> shown;             ///< (V) as in CutSurface; empty: nowhere
    std::vector<double> sizes;             ///< (F) as in FlatSurface; empty: 1
    std::vector<Index> polygon;            ///< (F) faces with the same number are not cut apart; empty: all may be
    double slit = 0.0;                     ///< length of the slit
    std::vector<Index> tips;               ///< tips of the darts (darts.h)
    double dart_length = 0.0;              ///< length of all darts
    bool along_axes = false;               ///< it lies along the axes already: packing turns it by quarter turns only
    Complex up = 0.0;                      ///< where up in the world is in the plane, of length 1; 0: not clear
    bool has_copy = false;                 ///< another part has the same map, not mirrored (twins.h)
    bool one_to_one = true;                ///< false: its boundary crosses itself
    bool is_near = false;                  ///< nearly as even as it can be: it was relaxed on a coarse surface

    bool is_cut_open() const { return slit + dart_length > 0.0; }
};

struct FlatOptions {
    CutPrices prices = {};                    ///< of parts and of slits
    bool round_cuts = false;                  ///< rims at cuts stay on circles and lines
    MapPurpose purpose = MapPurpose::result;  ///< judging: parts are only measured, and flaws stay
};

/// Lays a part flat as a disk or a tube, then frees its rims (free_rims.h). A tube becomes a disk if it cannot be
/// opened, if it has more faces turned over, or if its slit costs more than the disk's overflow.
FlatPart flat_part(const Part& part, const FlatOptions& options, ExecutionContext& context);

/// A surface as one part, without places in the plane.
FlatPart whole_part(const CutSurface& whole);

/// An edge, named by its vertices in the whole. So it has the same name in every part.
using EdgeEnds = std::pair<Index, Index>;
inline EdgeEnds sorted_ends(Index a, Index b) { return std::minmax(a, b); }

/// @param vertex, face functions of their numbers; a vertex without a mirror image has the image -1
template <typename OfVertex, typename OfFace>
void rename_elements(std::vector<FlatPart>& parts, const OfVertex& vertex, const OfFace& face)
{
    for (FlatPart& part : parts) {
        for (Index& f : part.faces) f = face(f);
        for (Index& v : part.original) v = vertex(v);
        for (Index& v : part.image) v = v < 0 ? v : vertex(v);
        for (VertexLoop& loop : part.loops)
            for (Index& v : loop) v = vertex(v);
    }
}

/// Gives parts their vertices' values. @param shown as in CutSurface, of the surface whose vertices the parts name
void note_shown(const std::vector<double>& shown, std::vector<FlatPart>& parts);

constexpr double packed_side = 1.25;  ///< about the side of a square that holds parts of total area 1

/// Gives a piece what the part knows of these vertices.
void take_vertices(const FlatPart& part, const std::vector<Index>& vertices, FlatPart& piece);

/// The sum of the angle errors of faces, in degrees.
double summed_angle_error(const Vertices& vertices, const Triangles& triangles, const PlanarPoints& points);

/// The same of a part's faces.
double sum_of_angle_errors(const FlatPart& part);
/// The same of the faces that are not turned over.
double sum_of_upright_angle_errors(const FlatPart& part);

/// Mean angle error of the parts' faces, in degrees.
double angle_error(const std::vector<FlatPart>& parts);

/// The texel densities of a flat part.
struct FlatDensity {
    VectorXd u;              ///< (F) 1/2 log(UV area / area); 0 for lost faces
    std::vector<char> lost;  ///< (F) 1 for a face without area, or without an edge longer than the floor
    double image = 0.0;      ///< UV area of all faces that are not turned over
};

/// @param areas (F) @param floor least length of an edge, in the unit of the points
FlatDensity flat_density(const FlatPart& flat, const VectorXd& areas, double floor = 0.0);

/// A part, or a whole piece, with its places in the unit disk. @param points (V, 2) these places
FlatPart flat_as_mapped(const PartMesh& mesh, const PlanarPoints& points);

/// The largest distance of each loop from its circle, over the radius. For a tube: from the end of the rectangle, over
/// the end's length for one turn. @param uv (V, 2)
std::vector<double> off_round(const FlatPart& part, const PlanarPoints& uv);

/// Whether no loop crosses itself or another loop, and only the outer loop runs counter-clockwise, as 32-bit floats.
/// Then a part without flips is one to one.
bool loops_apart(const FlatPart& part, const PlanarPoints& uv);

/// Whether all faces are upright, and loops are simple, apart and not turned, in 64 bits. @param points (V, 2)
bool lies_one_to_one(const FlatPart& part, const PlanarPoints& points);

}  // namespace koebe
