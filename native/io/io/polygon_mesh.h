// A mesh as filed: polygons of any size with shared vertices.
#pragma once

#include "core/types.h"

#include <span>
#include <vector>

namespace koebe {

/// The mesh of a file. It is written back with the same vertices and faces in the same order.
struct PolygonMesh {
    Vertices vertices;                 ///< in the unit of the file, in 64 bits
    std::vector<Index> corners;        ///< vertex of each corner, face after face
    std::vector<Index> face_begin{0};  ///< (F + 1) face f has corners [face_begin[f], face_begin[f + 1])

    Index face_count() const { return static_cast<Index>(face_begin.size()) - 1; }
    std::span<const Index> face(Index f) const
    {
        return {corners.data() + face_begin[f], corners.data() + face_begin[f + 1]};
    }
};

}  // namespace koebe
