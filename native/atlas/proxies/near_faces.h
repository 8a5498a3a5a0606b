// The faces of a proxy that are near faces of the fine surface.
#pragma once

#include "proxies/carried_net.h"

#include <array>
#include <vector>

namespace koebe {

using CornersInSpace = std::array<Eigen::RowVector3d, 3>;
CornersInSpace corners_of(const Vertices& vertices, const Triangles& triangles, Index f);

/// Coarse faces round the coarse vertices to which a fine face's corners went.
class NearFaces {
public:
    explicit NearFaces(const Proxy& proxy);

    /// The nearest one of them; -1: there is none.
    Index nearest(Index fine) const;

    /// (F) For each face of a piece the nearest coarse face of its part, on its side of all cuts: found by walks in the
    /// part, from faces that lie off its boundary. -1: there is none.
    std::vector<Index> of_piece(const FlatPart& piece, const CoarseNet& net, const FlatPart& part, int number) const;

private:
    double squared_distance(const Eigen::RowVector3d& place, Index coarse) const;
    Index walk(const Eigen::RowVector3d& place, const CoarseNet& net, const FlatPart& part, Index face) const;

    const Proxy& proxy_;
    std::vector<std::vector<Index>> around_;  // (V) coarse faces round each coarse vertex
};

}  // namespace koebe
