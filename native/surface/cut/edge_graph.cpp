#include "cut/edge_graph.h"

#include "core/numbering.h"

#include <boost/graph/dijkstra_shortest_paths.hpp>

#include <limits>
#include <utility>

namespace koebe {
namespace {

struct TreeVisitor : boost::default_dijkstra_visitor {
    explicit TreeVisitor(PathTree& grown) : tree(&grown) {}
    template <typename Vertex, typename Graph>
    void examine_vertex(Vertex vertex, const Graph&) const
    {
        tree->order.push_back(static_cast<Index>(vertex));
    }
    template <typename Edge, typename Graph>
    void edge_relaxed(const Edge& edge, const Graph& graph) const
    {
        const auto to = static_cast<std::size_t>(target(edge, graph));
        tree->halfedge[to] = graph[edge].halfedge;
        tree->parent[to] = static_cast<Index>(source(edge, graph));
    }
    PathTree* tree;
};

std::vector<double> priced_lengths(const SeamedMesh& mesh, double price)
{
    std::vector<char> on_boundary(mesh.fan_count, 0);
    for (Index h = 0; h < mesh.halfedge_count(); ++h)
        if (mesh.twin[h] == no_twin) on_boundary[origin(mesh.fans, h)] = on_boundary[target(mesh.fans, h)] = 1;
    std::vector<double> length = mesh.length;
    for (Index h = 0; h < mesh.halfedge_count(); ++h)
        if (on_boundary[origin(mesh.fans, h)] || on_boundary[target(mesh.fans, h)]) length[h] *= price;
    return length;
}

}  // namespace

EdgeGraph::EdgeGraph(const SeamedMesh& mesh, double price) : length_(priced_lengths(mesh, price))
{
    std::vector<std::pair<Index, Index>> ends;
    std::vector<Edge> edges;
    for (Index h = 0; h < mesh.halfedge_count(); ++h) {
        if (mesh.whole[h] || (mesh.twin[h] != no_twin && mesh.twin[h] < h)) continue;
        const Index a = origin(mesh.fans, h), b = target(mesh.fans, h);
        ends.insert(ends.end(), {{a, b}, {b, a}});
        edges.insert(edges.end(), 2, Edge{length_[h], h});
    }
    graph_ = Graph(boost::edges_are_unsorted_multi_pass, ends.begin(), ends.end(), edges.begin(), mesh.fan_count);
}

std::vector<Index> PathTree::path(Index fan) const
{
    std::vector<Index> halfedges;
    for (; parent[fan] != fan; fan = parent[fan]) halfedges.push_back(halfedge[fan]);
    return halfedges;
}

PathTree shortest_paths(const EdgeGraph& graph, const std::vector<Index>& sources)
{
    const auto& g = graph.graph();
    const auto count = num_vertices(g);
    PathTree tree{std::vector<double>(count, std::numeric_limits<double>::max()), std::vector<Index>(count, no_twin),
                  numbers_below(count)};
    std::vector<Index> before(count);
    const auto index = get(boost::vertex_index, g);
    boost::dijkstra_shortest_paths(
        g, sources.begin(), sources.end(), boost::make_iterator_property_map(before.begin(), index),
        boost::make_iterator_property_map(tree.distance.begin(), index), get(&EdgeGraph::Edge::length, g), index,
        std::less<>(), std::plus<>(), std::numeric_limits<double>::max(), 0.0, TreeVisitor(tree));
    return tree;
}

}  // namespace koebe
