// A part laid into the plane: as its disk, or its tube opened along a slit.
#pragma once

#include "execution/execution.h"
#include "splitting/splitting.h"

#include <vector>

namespace koebe {

/// A part with its slit open, a disk or a disk with holes, in UVs of its own unit.
struct FlatPart {
    std::vector<Index> faces;     ///< of the whole, in the order of the triangles
    std::vector<Index> original;  ///< vertex of the whole, for each vertex,
    std::vector<Index> image;     ///< and its mirror image; empty: the whole is no mirror image of itself
    Vertices vertices;            ///< (V, 3) with area 1 for the whole surface
    Surface surface;              ///< opened
    PlanarPoints points;          ///< (V, 2) with UV area as area in the mean, of the even window alone
    PartKind kind = PartKind::disk;
    std::vector<VertexLoop> loops;         ///< of the part before it is opened, by vertices of the whole
    std::vector<std::vector<Index>> rims;  ///< vertices that those loops have become
    std::vector<char> held;                ///< (V) 1 for vertices that stay on the circle or line of their rim
    std::vector<Index> polygon;            ///< (F) faces of one number are not cut apart; empty: each is one by itself
    double slit = 0.0;                     ///< length
    std::vector<Index> tips;               ///< of its darts (darts.h),
    double dart_length = 0.0;              ///< and the length of all
    bool one_to_one = true;                ///< false: its boundary crosses itself
};

struct FlatOptions {
    double slit_price = 0.0;  ///< of a slit as long as the root of the area, in overflow
    double part_price = 0.0;  ///< of a part, in overflow
    bool round_cuts = false;  ///< rims at cuts stay on circles and lines
};

/// The kind is that of the map; a tube that cannot be opened, or has more faces turned over, or whose slit costs more
/// than the disk's overflow, becomes a disk. Then free_rims.
FlatPart flat_part(const Part& part, const FlatOptions& options, ExecutionContext& context);

constexpr double packed_side = 1.25;  ///< of the square that parts of area 1 are packed into, about

/// The sum of its faces' angle errors, in degrees.
double sum_of_angle_errors(const FlatPart& part);

/// Mean angle error of the parts' faces, in degrees.
double angle_error(const std::vector<FlatPart>& parts);

/// Texel densities of a flat part.
struct FlatDensity {
    VectorXd u;              ///< (F) 1/2 log(UV area / area); 0 where it is lost
    std::vector<char> lost;  ///< (F) 1: no area, or no edge longer than the floor
    double image = 0.0;      ///< UV area of all faces that are not turned over
};

/// @param areas (F) @param floor in the unit of the points
FlatDensity flat_density(const FlatPart& flat, const VectorXd& areas, double floor = 0.0);

/// A part, or a whole piece, laid down as a map of the unit disk has it. @param points (V, 2)
FlatPart flat_as_mapped(const PartMesh& mesh, const PlanarPoints& points);

/// Of each loop, how far it is from the circle of a disk or the end of a tube's rectangle at most: over the circle's
/// radius, or the end's length over a turn. @param uv (V, 2)
std::vector<double> off_round(const FlatPart& part, const PlanarPoints& uv);

/// Whether no boundary loop crosses itself or another and one alone runs counter-clockwise, no hole being turned over,
/// as 32-bit floats: then a part without flips is one to one.
bool loops_apart(const FlatPart& part, const PlanarPoints& uv);

/// Turns flipped faces back where the part lies in the unit square: with the boundary held, and if that does not do,
/// with all vertices free as long as no loop comes to cross another.
/// @param uv (V, 2) in [0, 1]^2, changed in place @return faces still flipped as 32-bit floats
Index repair_flips(const FlatPart& part, PlanarPoints& uv, const ExecutionContext& context);

/// The part within the same box by the map that is one to one from its start, where the other has faces turned over or
/// loops that cross: a disk, less even. Nothing changes if that is no better.
/// @param uv (V, 2) in [0, 1]^2, changed in place
void embed_safely(FlatPart& part, PlanarPoints& uv, ExecutionContext& context);

}  // namespace koebe
