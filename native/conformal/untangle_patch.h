// A neighbourhood of flipped faces, and the attempt to turn them back.
#pragma once

#include "conformal/patch_shapes.h"
#include "conformal/result.h"
#include "core/execution.h"
#include "core/topology.h"

#include <vector>

namespace koebe {

/// What loop vertices may do: nothing; move if they are off their circles; and slide along them if they are not.
enum class PatchBoundary { held, freed, sliding };

/// A map under repair.
class TangledMap {
public:
    enum class Place : char { inside, on_circle, off_circle };

    /// @param circles of the loops @param off_circle vertices of loops that are free of their circles already
    TangledMap(const Vertices& vertices, const Surface& surface, const std::vector<VertexLoop>& loops,
               const std::vector<Circle>& circles, const std::vector<Index>& off_circle, PlanarPoints& uv);

    /// Faces that count: flipped as stored, and not below resolution.
    std::vector<Index> tangled() const;
    std::vector<Index> tangled(const std::vector<Index>& faces) const;

    /// The faces around some, `rings` rings wide, in groups that touch in no mobile vertex.
    std::vector<std::vector<Index>> patches(const std::vector<Index>& faces, int rings, PatchBoundary boundary) const;

    /// Minimizes on one patch, all that lies on its edge held; keeps the result if fewer of its faces are tangled and
    /// no loop crosses itself or another.
    /// @return whether it was kept
    bool repair(const std::vector<Index>& patch, PatchShape shape, PatchBoundary boundary,
                const ExecutionContext& context);

    /// A face with all three vertices on the outer loop is as thin as its arc: where that is less than 32-bit UVs
    /// resolve, its two outer ones go inward by 5e-7, within what counts as on the circle.
    /// @return whether fewer faces are tangled
    bool nudge(Index face);

    const Triangles& triangles() const { return surface_.triangles; }
    Place place(Index vertex) const { return place_[vertex]; }
    int loop_of(Index vertex) const { return loop_of_[vertex]; }
    /// Whether it lies on its circle, up to 1e-6 of the unit disk.
    bool near_circle(Index vertex) const;
    void set_place(Index vertex, Place place) { place_[vertex] = place; }

private:
    bool collapsed(Index vertex) const;
    bool hangs(Index face) const;
    std::size_t flipped(const std::vector<Index>& faces) const;
    bool mobile(Index vertex, PatchBoundary boundary) const;
    bool loops_cross(const std::vector<Index>& moved) const;

    const Vertices& vertices_;
    const Surface& surface_;
    const std::vector<VertexLoop>& loops_;
    const std::vector<Circle>& circles_;
    PlanarPoints& uv_;
    std::vector<Place> place_;
    std::vector<char> flap_;  // 1 for vertices off their circles from the start: rims of flaps
    std::vector<int> loop_of_;
    std::vector<Index> begin_, faces_of_;  // faces around each vertex
};

}  // namespace koebe
