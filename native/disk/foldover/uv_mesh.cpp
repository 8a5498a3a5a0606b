#include "foldover/uv_mesh.h"

#include "core/numbering.h"

#include <algorithm>
#include <array>
#include <utility>

namespace koebe {

UvMesh::UvMesh(const SurfacePolygons& surface, const PolygonOutlines& polygons, PlanarPoints& uv)
    : surface_(surface), polygons_(polygons), uv_(uv), node_(static_cast<std::size_t>(3 * surface.triangles.rows()))
{
    make_cells();
    make_nodes();
    for (Index c = 0; c < static_cast<Index>(node_.size()); ++c) corners_.push_back(c);
    std::ranges::stable_sort(corners_, {}, [&](Index c) { return node_[c]; });
    for (std::size_t i = 0; i < corners_.size(); ++i)
        while (begin_.size() <= static_cast<std::size_t>(node_[corners_[i]])) begin_.push_back(i);
    begin_.push_back(corners_.size());
}

bool UvMesh::between_two(Index corner) const
{
    const Index node = node_[corner];
    if (held(node) || at_rim_[node] != 0) return false;
    std::array<Index, 2> met{cell(corner), -1};
    for (const Index c : corners(node)) {
        if (cell(c) == met[0] || cell(c) == met[1]) continue;
        if (met[1] >= 0) return false;
        met[1] = cell(c);
    }
    return true;
}

void UvMesh::make_cells()
{
    cell_.assign(node_.size() / 3, -1);
    for (Index i = 0; i < polygons_.count(); ++i)
        for (const Index f : polygons_.faces(i)) cell_[f] = i;
    for (Index f = 0; f < static_cast<Index>(cell_.size()); ++f)
        if (cell_[f] < 0) {
            cell_[f] = polygons_.count() + static_cast<Index>(single_.size());
            single_.push_back(f);
        }
    cell_count_ = polygons_.count() + static_cast<Index>(single_.size());
}

void UvMesh::make_nodes()
{
    struct Side {
        Index low, high, from, to;  // vertices, and corners of the half-edge
    };
    std::vector<Side> sides;
    for (Index f = 0; f < static_cast<Index>(cell_.size()); ++f)
        for (int k = 0; k < 3; ++k) {
            const Index from = polygons_.corner(f, k), to = polygons_.corner(f, (k + 1) % 3);
            const Index a = polygons_.vertex(from), b = polygons_.vertex(to);
            sides.push_back({std::min(a, b), std::max(a, b), from, to});
        }
    const auto ends = [](const Side& side) { return std::pair(side.low, side.high); };
    std::ranges::stable_sort(sides, {}, ends);
    std::vector<Index> root = numbers_below(node_.size());
    const auto find = [&](Index c) {
        while (root[c] != c) c = root[c] = root[root[c]];
        return c;
    };
    std::vector<char> open(node_.size(), 0);
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
        while (end < sides.size() && ends(sides[end]) == ends(sides[begin])) ++end;
        const Side& one = sides[begin];
        const Side& two = sides[end - 1];
        const bool joined = end - begin == 2 && polygons_.vertex(one.from) == polygons_.vertex(two.to) &&
                            is_same_side(place(two.to) - place(one.from), place(two.from) - place(one.to));
        if (joined) {
            root[find(two.to)] = find(one.from);
            root[find(two.from)] = find(one.to);
        } else {
            for (std::size_t i = begin; i < end; ++i) open[sides[i].from] = open[sides[i].to] = 1;
        }
    }
    std::vector<Index> number(node_.size(), -1);
    for (Index c = 0; c < static_cast<Index>(node_.size()); ++c) {
        Index& own = number[find(c)];
        if (own < 0) {
            own = static_cast<Index>(held_.size());
            held_.push_back(0);
            at_rim_.push_back(0);
        }
        node_[c] = own;
        if (open[c] == 0) continue;
        at_rim_[own] = 1;
        if (!surface_.free_rims) held_[own] = 1;
    }
    if (surface_.held.empty()) return;
    std::vector<char> stays(static_cast<std::size_t>(surface_.vertices.rows()), 0);
    for (const Index v : surface_.held) stays[v] = 1;
    for (Index c = 0; c < static_cast<Index>(node_.size()); ++c)
        if (stays[polygons_.vertex(c)] != 0) held_[node_[c]] = 1;
}

}  // namespace koebe
