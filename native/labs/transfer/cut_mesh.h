// Cuts faces of a mesh so that given points of them become vertices.
#pragma once

#include "surface/surface_point.h"

#include <vector>

namespace koebe {

struct CutMesh {
    Triangles triangles;              ///< (F') the pieces
    std::vector<Index> face;          ///< (F') face of the mesh for each piece
    std::vector<SurfacePoint> added;  ///< places of the vertices V, V + 1, ... in the mesh
    std::vector<Index> vertex;        ///< vertex at each point: of the mesh, or an added one

    /// (V + added) rows of a field that is linear in each face of the mesh.
    template <typename Rows>
    Rows extended(const Rows& rows, const Triangles& of_mesh) const
    {
        Rows result(rows.rows() + static_cast<Eigen::Index>(added.size()), rows.cols());
        result.topRows(rows.rows()) = rows;
        for (std::size_t i = 0; i < added.size(); ++i)
            result.row(rows.rows() + static_cast<Eigen::Index>(i)) = added[i].of(rows, of_mesh);
        return result;
    }

    /// A point of a piece as a point of the mesh.
    SurfacePoint on_mesh(Index piece, const Eigen::RowVector3d& weights, const Triangles& of_mesh,
                         Index vertex_count) const;
};

/// Cuts a face into three at a point of it, or both faces at an edge into two. A point within 1e-8 of the face from an
/// edge or a vertex counts as on it.
CutMesh cut_at_points(const Triangles& triangles, Index vertex_count, const std::vector<SurfacePoint>& points);

}  // namespace koebe
