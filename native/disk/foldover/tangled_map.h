// A map while its flipped faces are turned back.
#pragma once

#include "circles/circle.h"
#include "mesh/topology.h"
#include "mesh/vertex_faces.h"

#include <algorithm>
#include <span>
#include <vector>

namespace koebe {

/// How loop vertices may move. held: no vertex. freed: vertices off their circles. sliding: all, and vertices on their
/// circles only along them.
enum class PatchBoundary { held, freed, sliding };

/// The surface, its map, and the kind of place of each vertex.
class TangledMap {
public:
    enum class Place : char { inside, on_circle, off_circle };

    /// @param loops the outer loop first @param circles of the loops
    /// @param off_circle loop vertices that are already off their circles @param uv (V, 2), moved in place
    TangledMap(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
               const std::vector<Circle>& circles, const std::vector<Index>& off_circle, PlanarPoints& uv);

    const Vertices& vertices() const { return vertices_; }
    const Triangles& triangles() const { return surface_.triangles; }
    const std::vector<VertexLoop>& loops() const { return loops_; }
    const std::vector<Circle>& circles() const { return circles_; }
    PlanarPoints& uv() { return uv_; }
    const PlanarPoints& uv() const { return uv_; }

    const VertexFaces& vertex_faces() const { return vertex_faces_; }
    std::span<const Index> faces_around(Index vertex) const { return vertex_faces_[vertex]; }
    /// The loop of a vertex; -1 inside.
    int loop_of(Index vertex) const { return loop_of_[vertex]; }
    Place place(Index vertex) const { return place_[vertex]; }
    void set_place(Index vertex, Place place) { place_[vertex] = place; }
    /// Keeps the vertex where it is from now on.
    void hold(Index vertex) { held_[vertex] = 1; }
    bool held(Index vertex) const { return held_[vertex] != 0; }
    /// Whether the vertex lies on its circle, up to inner_circle_tolerance.
    bool near_circle(Index vertex) const;

    /// Whether a vertex may move, and its faces are large enough to be moved in 64-bit positions.
    bool mobile(Index vertex, PatchBoundary boundary) const;
    /// Whether a face has a vertex on the rim of an ear.
    bool touches_ear(Index face) const;

    /// Faces that are flipped as stored, and not below resolution.
    std::vector<Index> tangled() const;
    std::vector<Index> tangled(const std::vector<Index>& faces) const;
    /// The number of flipped faces among some faces, including those below resolution.
    std::size_t flipped(const std::vector<Index>& faces) const;
    /// Whether a loop edge at one of these vertices, in ascending order, meets another loop edge.
    bool loops_cross(const std::vector<Index>& moved) const;
    /// Holes with one of these vertices, in ascending order, that run clockwise, as they should. If a vertex slides
    /// past another vertex on their circle, the hole turns over without a flipped face. Then the map covers the hole
    /// twice.
    std::vector<int> clockwise_holes(const std::vector<Index>& moved) const;

private:
    bool collapsed(Index vertex) const;

    const Vertices& vertices_;
    const Surface& surface_;
    const std::vector<VertexLoop>& loops_;
    const std::vector<Circle>& circles_;
    PlanarPoints& uv_;
    std::vector<Place> place_;
    std::vector<char> ear_;  // 1 for vertices off their circles from the start: rims of ears
    std::vector<char> held_;
    std::vector<int> loop_of_;
    VertexFaces vertex_faces_;
};

}  // namespace koebe
