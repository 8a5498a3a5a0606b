// Shortest paths along the edges of a seamed mesh.
#pragma once

#include "cut/seamed_mesh.h"

#include <boost/graph/compressed_sparse_row_graph.hpp>

#include <vector>

namespace koebe {

/// Fans, and the edges between them that may be cut. An edge that touches the boundary counts as longer, so that paths
/// avoid the boundary.
class EdgeGraph {
public:
    struct Edge {
        double length;
        Index halfedge;  ///< the lower of the edge's two half-edges
    };
    using Graph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, Edge, boost::no_property,
                                                     Index, Index>;

    /// @param price factor on the length of an edge that touches the boundary
    EdgeGraph(const SeamedMesh& mesh, double price);

    const Graph& graph() const { return graph_; }
    /// Length of an edge with the boundary's price; works for boundary edges too.
    double length(Index halfedge) const { return length_[halfedge]; }

private:
    std::vector<double> length_;
    Graph graph_;
};

struct PathTree {
    std::vector<double> distance;   ///< (fans) from the nearest source; the greatest number if there is no path
    std::vector<Index> halfedge;    ///< (fans) last half-edge of the path, in either direction; no_twin at the sources
    std::vector<Index> parent;      ///< (fans) the fan before on the path; itself at the sources
    std::vector<Index> order = {};  ///< fans with a path, by distance, each after its parent: edges may have no length

    /// Half-edges from the fan back to its source.
    std::vector<Index> path(Index fan) const;
};

/// Shortest paths by Dijkstra's algorithm (Boost.Graph).
PathTree shortest_paths(const EdgeGraph& graph, const std::vector<Index>& sources);

}  // namespace koebe
