// One copy of every face of a surface with handles, put together as a region of the plane.
#pragma once

#include "execution/execution.h"
#include "schottky/finer_faces.h"
#include "schottky/handle_cut.h"
#include "schottky/schottky_group.h"
#include "schottky/schottky_map.h"

#include <vector>

namespace koebe {

/// Faces of the cut surface where some copy of them lies.
struct SchottkyTile {
    Triangles triangles;            ///< (F, 3) of the tile's vertices
    std::vector<Index> vertex;      ///< of the cut surface for each vertex of the tile
    std::vector<GroupWord> word;    ///< what brings it from where the map has it
    PlanarPoints points;            ///< of the tile's vertices
    std::vector<VertexLoop> loops;  ///< its boundary, the outer one first
};

/// What is wrong with a tile.
struct SchottkyFaults {
    std::vector<Index> flipped;           ///< of the input, u and v rounded to 32 bits
    std::vector<Index> below_resolution;  ///< those of them whose longest edge is under uv_resolution
    bool boundary = false;                ///< it crosses itself, or runs the wrong way round
    bool any() const { return boundary || flipped.size() > below_resolution.size(); }
};

class SchottkyTiling {
public:
    /// @param faces what was cut, as the input's faces; both must outlive this
    /// @param polygon (F) faces of the input with one number stay together; empty: each by itself
    SchottkyTiling(const HandleCut& cut, const FinerFaces& faces, const std::vector<Index>& polygon);

    /// The cut surface as the map has it, but for polygons that the cut divides.
    SchottkyTile as_cut(const SchottkyPlane& plane) const;

    /// Each polygon where its middle lies outside all circles; those round a hole together, and what would hang on the
    /// others by no edge beside its neighbours.
    SchottkyTile by_circles(const SchottkyPlane& plane, const FundamentalCircles& circles) const;

    /// Turns flipped faces back (untangle), the tile's boundary held but for the holes, whose vertices slide.
    /// @param plane its z is moved in place; the sides of cuts stay the generators apart
    void turn_back(const SchottkyTile& tile, SchottkyPlane& plane, const ExecutionContext& context) const;

    /// The vertex itself, or that on the first side of its cut.
    Index first_side_of(Index vertex) const { return first_side_[vertex]; }
    /// What brings the corner's vertex, on the first side, to the copy that its polygon has.
    GroupWord corner_word(Index halfedge) const;

private:
    struct Step {
        Index halfedge = -1;  // on the other side, of the cut surface; -1 at a hole
        int letter = 0;       // by which the other side's word is longer
    };

    SchottkyTile put_together(const SchottkyPlane& plane, const std::vector<GroupWord>& words) const;
    std::vector<GroupWord> joined(std::vector<GroupWord> words) const;
    GroupWord word_of(const GroupWord& unit, Index face) const;

    const HandleCut& cut_;
    const FinerFaces& faces_;
    std::vector<Step> across_;                  // (3F) of each half-edge
    std::vector<Index> unit_;                   // (F)
    std::vector<std::vector<Index>> faces_of_;  // of each unit
    std::vector<GroupWord> in_unit_;            // (F) of the cut surface, against its unit's first face
    std::vector<Index> first_side_;             // (V) the vertex itself, or that on the first side of its cut
    std::vector<int> letter_;                   // (V) what brings it from there; 0 for itself
};

/// The k-th hole as the tile has it: its vertices in the input's numbers, its circle there, and who is off it.
/// @param vertex_count of the input: vertices beyond are inside its edges, and not named
SchottkyHole hole_in(const SchottkyTile& tile, const SchottkyPlane& plane, const HandleCut& cut, std::size_t k,
                     Index vertex_count);

SchottkyFaults find_faults(const SchottkyTile& tile);

}  // namespace koebe
