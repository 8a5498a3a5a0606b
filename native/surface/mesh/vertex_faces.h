// The faces around each vertex, and the rings of faces around some faces.
#pragma once

#include "core/types.h"

#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace koebe {

/// The faces around each vertex, ascending.
class VertexFaces {
public:
    VertexFaces() = default;
    VertexFaces(const Triangles& triangles, Index vertex_count)
        : begin_(static_cast<std::size_t>(vertex_count) + 1, 0), faces_(static_cast<std::size_t>(triangles.size()))
    {
        for (Eigen::Index c = 0; c < triangles.size(); ++c) ++begin_[triangles.data()[c] + 1];
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        std::vector<Index> next(begin_.begin(), begin_.end() - 1);
        for (Eigen::Index c = 0; c < triangles.size(); ++c)
            faces_[next[triangles.data()[c]]++] = static_cast<Index>(c / 3);
    }

    std::span<const Index> operator[](Index vertex) const
    {
        return {faces_.data() + begin_[vertex], faces_.data() + begin_[vertex + 1]};
    }

    /// Some faces, and ring after ring the faces that share a vertex with the ring before.
    std::vector<Index> with_rings(const Triangles& triangles, std::vector<Index> faces, int rings) const
    {
        std::vector<char> taken(static_cast<std::size_t>(triangles.rows()), 0);
        for (const Index f : faces) taken[f] = 1;
        std::size_t begin = 0;
        for (int ring = 0; ring < rings; ++ring)
            for (const std::size_t end = faces.size(); begin < end; ++begin)
                for (const Index v : triangles.row(faces[begin]))
                    for (const Index f : (*this)[v])
                        if (!std::exchange(taken[f], 1)) faces.push_back(f);
        return faces;
    }

private:
    std::vector<Index> begin_, faces_;
};

}  // namespace koebe
