#include "cut/slits.h"

#include "core/connectivity.h"
#include "cut/edge_graph.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace koebe {
namespace {

Index farthest_fan(const PathTree& tree)
{
    return static_cast<Index>(std::ranges::max_element(tree.distance) - tree.distance.begin());
}

std::vector<Index> slit_of_closed(const SeamedMesh& mesh)
{
    const EdgeGraph graph(mesh, 1.0);
    const Index end = farthest_fan(shortest_paths(graph, {0}));
    const PathTree tree = shortest_paths(graph, {end});
    std::vector<Index> path = tree.path(farthest_fan(tree));
    return path.size() >= 2 ? path : short_slit(mesh);
}

double length_of_loop(const SeamedMesh& mesh, const std::vector<Index>& loop)
{
    double length = 0.0;
    for (const Index h : loop) length += mesh.length[h];
    return length;
}

}  // namespace

std::vector<Index> short_slit(const SeamedMesh& mesh)
{
    std::array<std::vector<double>, 2> length;
    std::array<std::vector<Index>, 2> edge;
    for (int i = 0; i < 2; ++i) {
        length[i].assign(mesh.fan_count, std::numeric_limits<double>::max());
        edge[i].assign(mesh.fan_count, no_twin);
    }
    // The two shortest edges at each fan.
    const auto offer = [&](Index fan, Index h) {
        if (mesh.length[h] < length[0][fan]) {
            length[1][fan] = length[0][fan];
            edge[1][fan] = edge[0][fan];
            length[0][fan] = mesh.length[h];
            edge[0][fan] = h;
        } else if (mesh.length[h] < length[1][fan]) {
            length[1][fan] = mesh.length[h];
            edge[1][fan] = h;
        }
    };
    for (Index h = 0; h < mesh.halfedge_count(); ++h)
        if (!mesh.whole[h] && mesh.twin[h] > h) {
            offer(origin(mesh.fans, h), h);
            offer(target(mesh.fans, h), h);
        }
    Index best = -1;
    for (Index v = 0; v < mesh.fan_count; ++v)
        if (edge[1][v] != no_twin && (best < 0 || length[0][v] + length[1][v] < length[0][best] + length[1][best]))
            best = v;
    return best < 0 ? std::vector<Index>{} : std::vector<Index>{edge[0][best], edge[1][best]};
}

std::vector<Index> long_slit(const SeamedMesh& mesh)
{
    const auto loops = boundary_halfedges(mesh);
    if (loops.empty()) return slit_of_closed(mesh);
    const auto longest = static_cast<std::size_t>(
        std::ranges::max_element(loops, {}, [&](const auto& loop) { return length_of_loop(mesh, loop); }) -
        loops.begin());
    std::vector<Index> loop_of(mesh.fan_count, -1), sources;
    for (std::size_t k = 0; k < loops.size(); ++k)
        for (const Index h : loops[k]) loop_of[origin(mesh.fans, h)] = static_cast<Index>(k);
    for (const Index h : loops[longest]) sources.push_back(origin(mesh.fans, h));
    const PathTree tree = shortest_paths(EdgeGraph(mesh, 1.0), sources);
    std::vector<Index> nearest(loops.size(), -1);
    for (Index v = 0; v < mesh.fan_count; ++v)
        if (const Index k = loop_of[v]; k >= 0 && (nearest[k] < 0 || tree.distance[v] < tree.distance[nearest[k]]))
            nearest[k] = v;
    Index end = loops.size() == 1 ? farthest_fan(tree) : nearest[longest];
    if (loops.size() > 1)
        for (const Index v : nearest)
            if (tree.distance[v] > tree.distance[end]) end = v;
    std::vector<Index> path = tree.path(end);
    std::ranges::reverse(path);
    // Stop at the first other loop: beyond it the path would cut a part off.
    Index at = end;
    std::vector<Index> fans{end};
    while (tree.parent[at] != at) fans.push_back(at = tree.parent[at]);
    std::ranges::reverse(fans);
    for (std::size_t i = 1; i < fans.size(); ++i)
        if (loop_of[fans[i]] >= 0) {
            path.resize(i);
            break;
        }
    return path;
}

}  // namespace koebe
