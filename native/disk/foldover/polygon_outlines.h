// The outlines of a surface's polygons, and whether they are convex on the surface and in the UVs.
#pragma once

#include "core/types.h"
#include "foldover/convex_polygons.h"

#include <cstddef>
#include <span>
#include <vector>

namespace koebe {

/// The faces of each polygon of two triangles or more, and the corners along its outline.
class PolygonOutlines {
public:
    /// @throws InputError there is not a polygon for each face
    explicit PolygonOutlines(const SurfacePolygons& surface);

    Index count() const { return static_cast<Index>(face_begin_.size()) - 1; }
    std::span<const Index> faces(Index i) const
    {
        return {faces_.data() + face_begin_[i], faces_.data() + face_begin_[i + 1]};
    }
    /// Half-edges along the outline, each by its first corner 3 f + k; empty if the outline is not one simple loop.
    std::span<const Index> outline(Index i) const
    {
        return {outlines_.data() + outline_begin_[i], outlines_.data() + outline_begin_[i + 1]};
    }
    /// The k-th corner of a face in the map's orientation, as 3 f + k in the input's.
    Index corner(Index face, int k) const { return 3 * face + (turned_[face] != 0 && k > 0 ? 3 - k : k); }
    Index vertex(Index corner) const { return surface_.triangles.data()[corner]; }

    bool convex_in_space(Index i) const;

    /// Whether each vertex has one place in the polygon, and all places make a convex polygon.
    bool convex_in(Index i, const PlanarPoints& uv) const;

    /// Whether a vertex of the polygon has two places.
    bool torn(Index i, const PlanarPoints& uv) const;

private:
    struct Edge {
        Index from, to, corner;
    };

    void add(std::span<const Index> faces);

    /// Half-edges without an opposite one in the polygon, in their order round it.
    void add_outline(std::span<const Index> faces);

    const SurfacePolygons& surface_;
    std::vector<char> turned_;
    std::vector<Index> faces_, outlines_;
    std::vector<std::size_t> face_begin_{0}, outline_begin_{0};
    std::vector<Edge> edges_, outer_;  // of one polygon
};

}  // namespace koebe
