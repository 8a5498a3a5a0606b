#include "parts/dual_cut.h"

#include "core/connectivity.h"
#include "core/length.h"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>

#include <algorithm>
#include <map>
#include <numeric>

namespace koebe {
namespace {

constexpr Index least_piece = 10;  // faces

using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
using Graph = boost::adjacency_list<
    boost::vecS, boost::vecS, boost::directedS,
    boost::property<boost::vertex_color_t, boost::default_color_type,
                    boost::property<boost::vertex_distance_t, long,
                                    boost::property<boost::vertex_predecessor_t, Traits::edge_descriptor>>>,
    boost::property<boost::edge_capacity_t, double,
                    boost::property<boost::edge_residual_capacity_t, double,
                                    boost::property<boost::edge_reverse_t, Traits::edge_descriptor>>>>;

double edge_length(const PartMesh& part, Index h)
{
    return length_of(part.vertices.row(origin(part.surface.triangles, h)) -
                     part.vertices.row(target(part.surface.triangles, h)));
}

void add_edge(Graph& graph, Index a, Index b, double capacity)
{
    const auto forth = boost::add_edge(a, b, graph).first;
    const auto back = boost::add_edge(b, a, graph).first;
    boost::put(boost::edge_capacity, graph, forth, capacity);
    boost::put(boost::edge_capacity, graph, back, capacity);
    boost::put(boost::edge_reverse, graph, forth, back);
    boost::put(boost::edge_reverse, graph, back, forth);
}

/// Gives the faces round a loop to the side that some of them are on; joined they are where none of them is.
std::vector<Index> join_round_loops(const PartMesh& part, std::vector<Side>& sides)
{
    std::vector<Index> group(sides.size());
    std::iota(group.begin(), group.end(), 0);
    std::vector<int> loop_of(part.surface.vertex_count, -1);
    for (std::size_t k = 0; k < part.surface.loops.size(); ++k)
        for (const Index v : part.surface.loops[k]) loop_of[v] = static_cast<int>(k);
    std::vector<std::vector<Index>> round(part.surface.loops.size());
    for (Index f = 0; f < static_cast<Index>(sides.size()); ++f)
        for (int k = 0; k < 3; ++k)
            if (const int loop = loop_of[part.surface.triangles(f, k)]; loop >= 0) {
                round[loop].push_back(f);
                break;
            }
    for (const auto& faces : round) {
        bool inside = false, outside = false;
        for (const Index f : faces) {
            inside |= sides[f] == Side::inside;
            outside |= sides[f] == Side::outside;
        }
        if (inside && outside) continue;
        for (const Index f : faces) {
            if (inside || outside)
                sides[f] = inside ? Side::inside : Side::outside;
            else
                group[f] = faces.front();
        }
    }
    return group;
}

/// Pieces of a few faces take the label round them.
void drop_crumbs(const PartMesh& part, std::vector<int>& label)
{
    for (int round = 0; round < 4; ++round) {
        Index count = 0;
        const std::vector<Index> piece = connected_pieces(part, label, count);
        std::vector<Index> size(count, 0);
        for (const Index p : piece) ++size[p];
        bool changed = false;
        for (std::size_t f = 0; f < label.size(); ++f)
            if (count > 1 && size[piece[f]] < least_piece) {
                label[f] = 1 - label[f];
                changed = true;
            }
        if (!changed) return;
    }
}

}  // namespace

std::vector<int> minimum_cut(const PartMesh& part, const std::vector<Side>& given)
{
    std::vector<Side> sides = given;
    const std::vector<Index> group = join_round_loops(part, sides);
    constexpr Index source = 0, sink = 1;
    std::vector<Index> node(sides.size(), -1);
    Index count = 2;
    bool inside = false, outside = false;
    for (std::size_t f = 0; f < sides.size(); ++f) {
        inside |= sides[f] == Side::inside;
        outside |= sides[f] == Side::outside;
        if (sides[f] == Side::free && group[f] == static_cast<Index>(f)) node[f] = count++;
    }
    if (!inside || !outside) return {};
    for (std::size_t f = 0; f < sides.size(); ++f)
        node[f] = sides[f] == Side::inside ? source : sides[f] == Side::outside ? sink : node[group[f]];

    Graph graph(count);
    std::vector<double> to_source(count, 0.0), to_sink(count, 0.0);
    for (Index h = 0; h < static_cast<Index>(part.surface.twin.size()); ++h) {
        const Index t = part.surface.twin[h];
        if (t == no_twin || t < h) continue;
        Index a = node[face_of(h)], b = node[face_of(t)];
        if (a == b || a + b == source + sink) continue;
        if (a > b) std::swap(a, b);
        const double length = edge_length(part, h);
        if (a == source)
            to_source[b] += length;
        else if (a == sink)
            to_sink[b] += length;
        else
            add_edge(graph, a, b, length);
    }
    for (Index v = 2; v < count; ++v) {
        if (to_source[v] > 0.0) add_edge(graph, source, v, to_source[v]);
        if (to_sink[v] > 0.0) add_edge(graph, v, sink, to_sink[v]);
    }
    boost::boykov_kolmogorov_max_flow(graph, source, sink);
    const auto color = boost::get(boost::vertex_color, graph);
    std::vector<int> label(sides.size());
    for (std::size_t f = 0; f < sides.size(); ++f)
        label[f] = node[f] == source || (node[f] != sink && color[node[f]] == color[source]);
    drop_crumbs(part, label);
    if (std::ranges::count(label, 1) == 0 || std::ranges::count(label, 0) == 0) return {};
    return label;
}

}  // namespace koebe
