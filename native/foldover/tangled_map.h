// A map whose flipped faces are being turned back.
#pragma once

#include "circles/circle.h"
#include "mesh/topology.h"

#include <algorithm>
#include <span>
#include <vector>

namespace koebe {

/// What loop vertices may do: nothing; move if they are off their circles; and slide along them if they are not.
enum class PatchBoundary { held, freed, sliding };

/// The surface, its map, and where each vertex of the map is.
class TangledMap {
public:
    enum class Place : char { inside, on_circle, off_circle };

    /// @param loops the outer one first @param circles of the loops
    /// @param off_circle vertices of loops that are free of their circles already @param uv (V, 2), moved in place
    TangledMap(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
               const std::vector<Circle>& circles, const std::vector<Index>& off_circle, PlanarPoints& uv);

    const Vertices& vertices() const { return vertices_; }
    const Triangles& triangles() const { return surface_.triangles; }
    const std::vector<VertexLoop>& loops() const { return loops_; }
    const std::vector<Circle>& circles() const { return circles_; }
    PlanarPoints& uv() { return uv_; }
    const PlanarPoints& uv() const { return uv_; }

    std::span<const Index> faces_around(Index vertex) const
    {
        return {faces_of_.data() + begin_[vertex], faces_of_.data() + begin_[vertex + 1]};
    }
    /// -1 inside.
    int loop_of(Index vertex) const { return loop_of_[vertex]; }
    Place place(Index vertex) const { return place_[vertex]; }
    void set_place(Index vertex, Place place) { place_[vertex] = place; }
    /// From now on the vertex stays where it is.
    void hold(Index vertex) { held_.push_back(vertex); }
    bool held(Index vertex) const { return std::ranges::find(held_, vertex) != held_.end(); }
    /// Whether it lies on its circle, up to inner_circle_tolerance.
    bool near_circle(Index vertex) const;

    /// Whether a vertex may move, and anything around it is large enough for 64-bit positions to do so with sense.
    bool mobile(Index vertex, PatchBoundary boundary) const;
    /// Whether a face has a vertex on the rim of a flap.
    bool hangs(Index face) const;

    /// Faces that count: flipped as stored, and not below resolution.
    std::vector<Index> tangled() const;
    std::vector<Index> tangled(const std::vector<Index>& faces) const;
    /// How many of some faces are flipped, those below resolution too.
    std::size_t flipped(const std::vector<Index>& faces) const;
    /// Whether an edge of a loop at one of these vertices, in rising order, meets another edge of any loop.
    bool loops_cross(const std::vector<Index>& moved) const;
    /// Holes with one of these vertices, in rising order, that run clockwise, as holes should. A vertex that slides
    /// past another one on their circle turns the hole over, with no face flipped: the map covers it then, and twice.
    std::vector<int> clockwise_holes(const std::vector<Index>& moved) const;

private:
    bool collapsed(Index vertex) const;

    const Vertices& vertices_;
    const Surface& surface_;
    const std::vector<VertexLoop>& loops_;
    const std::vector<Circle>& circles_;
    PlanarPoints& uv_;
    std::vector<Place> place_;
    std::vector<char> flap_;  // 1 for vertices off their circles from the start: rims of flaps
    std::vector<Index> held_;
    std::vector<int> loop_of_;
    std::vector<Index> begin_, faces_of_;  // faces around each vertex
};

}  // namespace koebe
