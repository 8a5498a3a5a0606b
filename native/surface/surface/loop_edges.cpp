#include "surface/loop_edges.h"

#include <algorithm>
#include <limits>

namespace koebe {

VectorXd loop_edges(const Vertices& vertices, const VertexLoop& loop)
{
    constexpr double shortest = 1e-9;  // of the mean
    VectorXd edges(loop.size());
    for (std::size_t i = 0; i < loop.size(); ++i)
        edges[i] = (vertices.row(loop[(i + 1) % loop.size()]) - vertices.row(loop[i])).stableNorm();
    return edges.cwiseMax(std::max(shortest * edges.mean(), std::numeric_limits<double>::min()));
}

}  // namespace koebe
