#include "splitting/dual_cut.h"

#include "core/connectivity.h"
#include "core/length.h"
#include "core/numbering.h"

#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // false alarms in the edges of Boost's graphs
#endif
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

#include <algorithm>
#include <unordered_map>

namespace koebe {
namespace {

constexpr Index least_piece = 4;  // faces: a limb of three sides has no more at its tip

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

/// Groups of faces that stay on one side: the faces of a polygon, and the faces round a loop, unless `sides` has both
/// sides there. Gives the faces of a group the same side.
class Groups {
public:
    Groups(const PartMesh& part, std::vector<Side>& sides) : sides_(sides), parent_(numbers_below(sides.size()))
    {
        join_polygons(part);
        join_round_loops(part);
        for (std::size_t f = 0; f < sides.size(); ++f) sides[f] = sides[root(static_cast<Index>(f))];
    }
    Index root(Index f)
    {
        while (parent_[f] != f) f = parent_[f] = parent_[parent_[f]];
        return f;
    }

private:
    void join(Index a, Index b)
    {
        a = root(a);
        b = root(b);
        if (a == b) return;
        if (sides_[a] == Side::free)
            sides_[a] = sides_[b];
        else if (sides_[b] != Side::free && sides_[b] != sides_[a])
            sides_[a] = Side::free;
        parent_[b] = a;
    }
    void join_polygons(const PartMesh& part)
    {
        if (part.polygon.empty()) return;
        std::unordered_map<Index, Index> first;
        for (std::size_t f = 0; f < part.polygon.size(); ++f)
            join(first.try_emplace(part.polygon[f], static_cast<Index>(f)).first->second, static_cast<Index>(f));
    }
    void join_round_loops(const PartMesh& part)
    {
        std::vector<int> loop_of(part.surface.vertex_count, -1);
        for (std::size_t k = 0; k < part.surface.loops.size(); ++k)
            for (const Index v : part.surface.loops[k]) loop_of[v] = static_cast<int>(k);
        std::vector<std::vector<Index>> round(part.surface.loops.size());
        for (Index f = 0; f < static_cast<Index>(sides_.size()); ++f)
            for (int k = 0; k < 3; ++k)
                if (const int loop = loop_of[part.surface.triangles(f, k)]; loop >= 0) {
                    round[loop].push_back(f);
                    break;
                }
        for (const auto& faces : round) {
            const auto any = [&](Side side) {
                return std::ranges::any_of(faces, [&](Index f) { return sides_[root(f)] == side; });
            };
            if (any(Side::inside) && any(Side::outside)) continue;
            for (const Index f : faces) join(faces.front(), f);
        }
    }

    std::vector<Side>& sides_;
    std::vector<Index> parent_;
};

/// Pieces of a few faces take the label round them.
void relabel_small_pieces(const PartMesh& part, std::vector<int>& label)
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

/// Faces with two edges on the cut go to the other side: the cut becomes shorter, and no face lies flat on a circle.
void drop_ears(const PartMesh& part, std::vector<int>& label)
{
    const auto is_alone = [&](Index f) {
        int across = 0;
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            const Index t = part.surface.twin[h];
            if (t == no_twin) continue;
            const Index g = face_of(t);
            if (label[g] != label[f])
                ++across;
            else if (!part.polygon.empty() && part.polygon[g] == part.polygon[f])
                return false;
        }
        return across >= 2;
    };
    std::vector<Index> queue = numbers_below(label.size());
    const std::size_t most = 4 * label.size();
    for (std::size_t head = 0; head < queue.size() && head < most; ++head) {
        const Index f = queue[head];
        if (!is_alone(f)) continue;
        label[f] = 1 - label[f];
        for (Index h = 3 * f; h < 3 * f + 3; ++h)
            if (const Index t = part.surface.twin[h]; t != no_twin) queue.push_back(face_of(t));
    }
}

}  // namespace

std::vector<int> minimum_cut(const PartMesh& part, const std::vector<Side>& given, const VectorXd& factor)
{
    // A node for each group of free faces that are not cut apart. Faces with a side are the source or the sink.
    std::vector<Side> sides = given;
    Groups groups(part, sides);
    constexpr Index source = 0, sink = 1;
    std::vector<Index> node(sides.size(), -1);
    Index count = 2;
    bool inside = false, outside = false;
    for (std::size_t f = 0; f < sides.size(); ++f) {
        inside |= sides[f] == Side::inside;
        outside |= sides[f] == Side::outside;
        if (sides[f] == Side::free && groups.root(static_cast<Index>(f)) == static_cast<Index>(f)) node[f] = count++;
    }
    if (!inside || !outside) return {};
    for (std::size_t f = 0; f < sides.size(); ++f)
        node[f] = sides[f] == Side::inside    ? source
                  : sides[f] == Side::outside ? sink
                                              : node[groups.root(static_cast<Index>(f))];

    // The capacity between two nodes is the length of their border.
    Graph graph(count);
    std::vector<double> to_source(count, 0.0), to_sink(count, 0.0);
    for (Index h = 0; h < static_cast<Index>(part.surface.twin.size()); ++h) {
        const Index t = part.surface.twin[h];
        if (t == no_twin || t < h) continue;
        Index a = node[face_of(h)], b = node[face_of(t)];
        if (a == b || a + b == source + sink) continue;
        if (a > b) std::swap(a, b);
        const double length = edge_length(part, h) * (factor.size() > 0 ? factor[h] : 1.0);
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
    // The cut of least length: what the source still reaches is inside.
    boost::boykov_kolmogorov_max_flow(graph, source, sink);
    const auto color = boost::get(boost::vertex_color, graph);
    std::vector<int> label(sides.size());
    for (std::size_t f = 0; f < sides.size(); ++f)
        label[f] = node[f] == source || (node[f] != sink && color[node[f]] == color[source]);
    drop_ears(part, label);
    relabel_small_pieces(part, label);
    if (std::ranges::count(label, 1) == 0 || std::ranges::count(label, 0) == 0) return {};
    return label;
}

}  // namespace koebe
