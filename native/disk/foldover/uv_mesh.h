// Corners of UVs that are one place, and the polygons round it.
#pragma once

#include "core/types.h"
#include "foldover/convex_polygons.h"
#include "foldover/polygon_outlines.h"

#include <cstddef>
#include <span>
#include <vector>

namespace koebe {

/// The corners of the UVs that are one place, and the polygons around it. A triangle outside all polygons is a cell of
/// its own, as each polygon is.
class UvMesh {
public:
    UvMesh(const SurfacePolygons& surface, const PolygonOutlines& polygons, PlanarPoints& uv);

    Index node(Index corner) const { return node_[corner]; }
    bool held(Index node) const { return held_[node] != 0; }
    /// Whether only two polygons meet at an inner vertex. Their angles there make a full turn, so one is not convex.
    bool between_two(Index corner) const;
    Index node_count() const { return static_cast<Index>(held_.size()); }
    std::span<const Index> corners(Index node) const
    {
        return {corners_.data() + begin_[node], corners_.data() + begin_[node + 1]};
    }
    Index cell(Index corner) const { return cell_[corner / 3]; }
    Index cell_count() const { return cell_count_; }
    std::span<const Index> faces(Index cell) const
    {
        return cell < polygons_.count() ? polygons_.faces(cell)
                                        : std::span<const Index>(&single_[cell - polygons_.count()], 1);
    }
    Complex place(Index corner) const { return {uv_(corner, 0), uv_(corner, 1)}; }

private:
    void make_cells();

    /// Joins the corners over edges whose two sides lie in one place, or differ by a translation if the map is
    /// periodic. A corner at any other edge is held.
    void make_nodes();

    bool is_same_side(Complex first, Complex second) const
    {
        return first == second && (surface_.periodic || first == Complex(0.0, 0.0));
    }

    const SurfacePolygons& surface_;
    const PolygonOutlines& polygons_;
    const PlanarPoints& uv_;
    std::vector<Index> cell_, single_;  // (F) cell of each face; faces outside all polygons
    Index cell_count_ = 0;
    std::vector<Index> node_;     // (3F)
    std::vector<char> held_;      // of each node
    std::vector<char> at_rim_;    // of each node: 1 on a loop, or on a side of a cut
    std::vector<Index> corners_;  // by node
    std::vector<std::size_t> begin_;
};

}  // namespace koebe
