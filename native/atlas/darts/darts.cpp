#include "darts/darts.h"

#include "core/complex_places.h"
#include "core/errors.h"
#include "core/numbering.h"
#include "cost/costs.h"
#include "cut/edge_graph.h"
#include "darts/tension.h"
#include "even/even_map.h"
#include "planar/planar_predicates.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace koebe {
namespace {

constexpr std::size_t most_darts = 16;  // opened together
constexpr double least_gap = 1e-4;      // between the sides of a cut, over the least height of a face beside it

/// The path from a vertex to the boundary. Its cost is a length, longer where the surface is shown. @return nothing if
/// the vertex is on it, or if there is no path
Dart shortest_dart(const FlatPart& flat, const PathTree& tree, Index tip)
{
    const Triangles& triangles = flat.surface.triangles;
    Dart dart;
    dart.halfedges = tree.path(tip);
    dart.cost = tree.distance[tip];
    dart.vertices.push_back(tip);
    for (const Index h : dart.halfedges) {
        const Index a = origin(triangles, h), b = target(triangles, h);
        dart.vertices.push_back(a == dart.vertices.back() ? b : a);
        dart.length += (flat.vertices.row(a) - flat.vertices.row(b)).norm();
    }
    return dart;
}

/// The force that pulls the two sides of a dart apart.
double pull_apart(const Tension& tension, const Dart& dart)
{
    double sum = 0.0;
    const std::vector<Index>& path = dart.vertices;
    for (std::size_t i = 1; i < path.size(); ++i)
        sum += tension.at(path[i], path[i - 1], i + 1 < path.size() ? path[i + 1] : -1).imag();
    return sum;
}

/// (V) distances on the surface from vertices, infinite where no path leads.
VectorXd distances(const FlatPart& flat, const std::vector<Index>& sources)
{
    const PathTree tree = shortest_paths(EdgeGraph(seamed(flat), 1.0), sources);
    return Eigen::Map<const VectorXd>(tree.distance.data(), flat.surface.vertex_count);
}

/// A vertex between its neighbours on the boundary, the surface on the left, moved into the surface.
Complex drawn_in(const PlanarPoints& points, Index before, Index v, Index after, double by)
{
    const Complex out = complex_at(points, after) - complex_at(points, v),
                  in = complex_at(points, before) - complex_at(points, v);
    if (out == 0.0 || in == 0.0) return complex_at(points, v);
    double angle = std::arg(in / out);
    if (angle <= 0.0) angle += 2.0 * std::numbers::pi;
    return complex_at(points, v) + std::polar(by, std::arg(out) + 0.5 * angle);
}

/// (V) the least height of the faces round each vertex.
VectorXd least_heights(const FlatPart& flat)
{
    VectorXd least = VectorXd::Constant(flat.points.rows(), std::numeric_limits<double>::infinity());
    for (Eigen::Index f = 0; f < flat.surface.triangles.rows(); ++f) {
        const CornerPlaces at = corners_of(flat.points, flat.surface.triangles, f);
        const double edge = std::max({distance(at[0], at[1]), distance(at[1], at[2]), distance(at[2], at[0])});
        const double height = std::max(cross(at[1] - at[0], at[2] - at[0]), 0.0) / std::max(edge, 1e-300);
        for (const Index v : flat.surface.triangles.row(f)) least[v] = std::min(least[v], height);
    }
    return least;
}

}  // namespace

std::vector<Dart> promising_darts(const FlatPart& flat, const EvenForces& forces, double even, double price,
                                  const std::vector<char>& refused)
{
    if (is_true_to_size(flat)) return {};
    const Triangles& triangles = flat.surface.triangles;
    const std::vector<char> outside = boundary_mask(flat.surface);
    const EdgeGraph graph(seamed(flat, flat.shown), 1.0);
    const Tension tension(flat, forces);
    std::vector<std::pair<double, Dart>> found;
    VectorXd from_round = VectorXd::Constant(flat.surface.vertex_count, std::numeric_limits<double>::infinity());
    // The dart from each vertex to the nearest rim that stays round, and to the nearest free one.
    for (const bool round : {true, false}) {
        std::vector<Index> sources;
        for (Index v = 0; v < flat.surface.vertex_count; ++v)
            if (outside[v] && (flat.held[v] != 0) == round) sources.push_back(v);
        if (sources.empty()) continue;
        const PathTree tree = shortest_paths(graph, sources);
        if (round) from_round = distances(flat, sources);
        for (Index v = 0; v < flat.surface.vertex_count; ++v) {
            if (outside[v] || tree.parent[v] == v || tree.distance[v] > tuning::longest_dart ||
                (!refused.empty() && refused[v]))
                continue;
            Dart dart = shortest_dart(flat, tree, v);
            if (std::ranges::any_of(dart.vertices.begin(), std::prev(dart.vertices.end()), [&](Index w) {
                    return outside[w] != 0 || (!round && from_round[w] < tuning::dart_spacing);
                }))
                continue;
            // It pays if a crack there would release more than it costs.
            const double pulled = pull_apart(tension, dart);
            if (!(pulled > 0.0)) continue;
            dart.gain = (round ? tuning::released_share : 1.0) * crack_energy(pulled, even);
            const Index start = dart.vertices.back();
            const bool is_longer = std::ranges::count(flat.tips, start) > 0;
            dart.cost = dart_cost(price, dart.cost, !is_longer, price_of_edge(flat.shown, start, start));
            const double surplus = dart.gain - dart.cost;
            if (surplus > 0.0) found.emplace_back(surplus, std::move(dart));
        }
    }
    std::ranges::stable_sort(found, std::ranges::greater(), [](const auto& one) { return one.first; });
    // The most promising ones, apart from each other.
    double part_area = 0.0;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) part_area += signed_area(flat.points, triangles, f);
    const double gap = std::min(tuning::dart_spacing, tuning::cut_reach * std::sqrt(std::max(part_area, 0.0)));
    std::vector<char> taken(static_cast<std::size_t>(flat.surface.vertex_count), 0);
    std::vector<Dart> darts;
    for (auto& promising : found) {
        Dart& dart = promising.second;
        // A crack unloads what lies beside it, about as far as it is long.
        const auto is_near = [&](const Dart& other) {
            const auto between = flat.vertices.row(other.vertices.front()) - flat.vertices.row(dart.vertices.front());
            return between.norm() < std::max({gap, dart.length, other.length});
        };
        if (std::ranges::any_of(darts, is_near) ||
            std::ranges::any_of(dart.vertices, [&](Index v) { return taken[v]; }))
            continue;
        for (const Index v : dart.vertices) taken[v] = 1;
        darts.push_back(std::move(dart));
        if (darts.size() == most_darts) break;
    }
    return darts;
}

std::optional<std::vector<Index>> open_darts(FlatPart& flat, const std::vector<Dart>& darts)
{
    SeamedMesh mesh = seamed(flat);
    for (const Dart& dart : darts)
        for (const Index h : dart.halfedges) mesh.cut(h);
    number_fans(mesh);
    // A vertex keeps its number on its first side.
    std::vector<Index> own(static_cast<std::size_t>(mesh.fan_count), -1), source;
    std::vector<char> kept(static_cast<std::size_t>(flat.points.rows()), 0);
    source = numbers_below(kept.size());
    Triangles opened(mesh.corners.rows(), 3);
    for (Eigen::Index c = 0; c < opened.size(); ++c) {
        const Index v = mesh.corners.data()[c];
        Index& number = own[mesh.fans.data()[c]];
        if (number < 0) {
            number = std::exchange(kept[v], 1) ? static_cast<Index>(source.size()) : v;
            if (number != v) source.push_back(v);
        }
        opened.data()[c] = number;
    }
    FlatPart after = flat;
    try {
        after.surface = require_bordered_genus_zero(opened, static_cast<Index>(source.size()));
    } catch (const TopologyError&) {
        return {};
    }
    const std::vector<char> outside = boundary_mask(flat.surface);
    const auto joins = [&](const Dart& dart) { return outside[dart.vertices.front()] != 0; };
    const std::size_t joined = static_cast<std::size_t>(std::ranges::count_if(darts, joins));
    if (after.surface.loops.size() + joined != flat.surface.loops.size()) return {};
    take_vertices(flat, source, after);
    std::vector<Index> second(kept.size(), -1);
    for (std::size_t i = kept.size(); i < source.size(); ++i) second[source[i]] = static_cast<Index>(i);
    for (std::vector<Index>& rim : after.rims) {
        const std::size_t count = rim.size();
        for (std::size_t i = 0; i < count; ++i)
            if (second[rim[i]] >= 0) rim.push_back(second[rim[i]]);
    }
    std::vector<char> moves(source.size(), 0);
    for (const Dart& dart : darts)
        for (std::size_t i = joins(dart) ? 0 : 1; i < dart.vertices.size(); ++i) {
            const Index v = dart.vertices[i];
            moves[v] = 1;
            if (second[v] >= 0) moves[second[v]] = 1;
        }
    if (!draw_apart(after, moves)) return {};
    for (const Dart& dart : darts) {
        std::erase(after.tips, dart.vertices.back());
        if (!joins(dart)) after.tips.push_back(dart.vertices.front());
        (joins(dart) ? after.slit : after.dart_length) += dart.length;
    }
    flat = std::move(after);
    return source;
}

bool draw_apart(FlatPart& flat, const std::vector<char>& moves, double gap)
{
    const VectorXd heights = least_heights(flat);
    const PlanarPoints before = flat.points;
    for (; gap > least_gap; gap *= 0.25) {
        for (const VertexLoop& loop : flat.surface.loops)
            for (std::size_t i = 0; i < loop.size(); ++i) {
                if (!moves[loop[i]]) continue;
                const Complex z = drawn_in(before, loop[(i + loop.size() - 1) % loop.size()], loop[i],
                                           loop[(i + 1) % loop.size()], gap * heights[loop[i]]);
                flat.points.row(loop[i]) << z.real(), z.imag();
            }
        if (lies_one_to_one(flat, flat.points)) return true;
    }
    flat.points = before;
    return false;
}

std::vector<int> nearest_cut(const FlatPart& flat, const std::vector<std::vector<Index>>& cuts, double reach)
{
    SeamedMesh mesh = seamed(flat);
    std::ranges::fill(mesh.whole, 0);
    std::vector<Index> sources;
    std::vector<int> label(static_cast<std::size_t>(flat.surface.vertex_count), -1);
    for (std::size_t k = 0; k < cuts.size(); ++k)
        for (const Index v : cuts[k]) {
            sources.push_back(v);
            label[v] = static_cast<int>(k);
        }
    const PathTree tree = shortest_paths(EdgeGraph(mesh, 1.0), sources);
    for (const Index v : tree.order)
        if (tree.parent[v] != v && tree.distance[v] < reach) label[v] = label[tree.parent[v]];
    std::vector<int> nearest(static_cast<std::size_t>(flat.surface.triangles.rows()));
    for (Eigen::Index f = 0; f < flat.surface.triangles.rows(); ++f) nearest[f] = label[flat.surface.triangles(f, 0)];
    return nearest;
}

}  // namespace koebe
