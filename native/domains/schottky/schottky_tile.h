// One copy of every face of a surface with handles, put together to a region of the plane.
#pragma once

#include "execution/execution.h"
#include "schottky/finer_faces.h"
#include "schottky/handle_cut.h"
#include "schottky/schottky_group.h"
#include "schottky/schottky_map.h"

#include <vector>

namespace koebe {

/// Faces of the cut surface, each at some copy's place.
struct SchottkyTile {
    Triangles triangles;            ///< (F, 3) of the tile's vertices
    std::vector<Index> vertex;      ///< vertex of the cut surface for each vertex of the tile
    std::vector<GroupWord> word;    ///< moves a vertex from the map's place to the tile's
    PlanarPoints points;            ///< of the tile's vertices
    std::vector<VertexLoop> loops;  ///< its boundary, the outer one first
};

/// The faults of a tile.
struct SchottkyFaults {
    std::vector<Index> flipped;           ///< faces of the input, with u and v rounded to 32 bits
    std::vector<Index> below_resolution;  ///< flipped faces whose longest edge is under uv_resolution
    bool boundary = false;                ///< the boundary crosses itself, or runs the wrong way
    bool any() const { return boundary || flipped.size() > below_resolution.size(); }
};

class SchottkyTiling {
public:
    /// @param cut, faces must outlive the tiling; the faces are the input's that were cut
    /// @param polygon (F) faces of the input with one number stay together; empty: each face by itself
    SchottkyTiling(const HandleCut& cut, const FinerFaces& faces, const std::vector<Index>& polygon);

    /// The cut surface as mapped, except for polygons that the cut divides.
    SchottkyTile as_cut(const SchottkyPlane& plane) const;

    /// Puts each polygon where its middle lies outside all circles. Polygons round a hole stay together. A polygon that
    /// would share no edge with the others goes beside its neighbours.
    SchottkyTile by_circles(const SchottkyPlane& plane, const FundamentalCircles& circles) const;

    /// Turns flipped faces back (untangle). The tile's boundary is held, but vertices of holes slide.
    /// @param plane its z is moved in place; generators still take one side of a cut to the other
    void turn_back(const SchottkyTile& tile, SchottkyPlane& plane, const ExecutionContext& context) const;

    /// The vertex itself, or its copy on the first side of its cut.
    Index first_side_of(Index vertex) const { return first_side_[vertex]; }
    /// The word that moves the corner's vertex, on the first side, to the copy in its polygon.
    GroupWord corner_word(Index halfedge) const;

private:
    struct Step {
        Index halfedge = -1;  // on the other side, in the cut surface; -1 at a hole
        int letter = 0;       // the additional letter of the word on the other side
    };

    SchottkyTile put_together(const SchottkyPlane& plane, const std::vector<GroupWord>& words) const;
    std::vector<GroupWord> joined(std::vector<GroupWord> words) const;
    GroupWord word_of(const GroupWord& unit, Index face) const;

    const HandleCut& cut_;
    const FinerFaces& faces_;
    std::vector<Step> across_;                  // (3F) of each half-edge
    std::vector<Index> unit_;                   // (F)
    std::vector<std::vector<Index>> faces_of_;  // faces of each unit
    std::vector<GroupWord> in_unit_;            // (F) of the cut surface, relative to its unit's first face
    std::vector<Index> first_side_;             // (V) the vertex itself, or its copy on the first side of its cut
    std::vector<int> letter_;                   // (V) moves a vertex from there; 0: it is there
};

/// The k-th hole in the tile: its vertices in the input's numbers, its circle, and its vertices off the circle.
/// @param vertex_count of the input: further vertices lie inside its edges, and are left out
SchottkyHole hole_in(const SchottkyTile& tile, const SchottkyPlane& plane, const HandleCut& cut, std::size_t k,
                     Index vertex_count);

SchottkyFaults find_faults(const SchottkyTile& tile);

}  // namespace koebe
