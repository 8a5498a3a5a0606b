#include "io/welding.h"

#include "core/counted.h"
#include "core/numbering.h"
#include "core/sort_unique.h"
#include "cut/disjoint_sets.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <span>
#include <string>
#include <utility>

namespace koebe {
namespace {

constexpr Index none_kept = -1;

/// The kept vertices, by the cells of a grid in a hash table.
class KeptVertices {
public:
    KeptVertices(const Vertices& vertices, double distance)
        : vertices_(vertices),
          distance_(distance),
          heads_(std::bit_ceil(2 * static_cast<std::size_t>(vertices.rows()) + 1), none_kept),
          next_(static_cast<std::size_t>(vertices.rows()), none_kept)
    {
        if (distance == 0.0) return;
        // Cells of some distances: a ball meets few of them, and few kept vertices lie in one. Coordinates are at most
        // 2^52 cells, so that neighbours differ.
        constexpr double distances_of_cell = 4.0, least_share = 0x1p-52;
        side_ = std::max(distances_of_cell * distance, least_share * vertices.cwiseAbs().maxCoeff());
    }

    /// The nearest kept vertex within the distance, the first one of those; or none_kept.
    Index nearest(Index v) const
    {
        Index found = none_kept;
        double least = 1.0;  // of squares, in distances
        const auto look = [&](const Cell& cell) {
            for (Index kept = heads_[bucket(cell)]; kept != none_kept; kept = next_[kept]) {
                const double square = distance_ == 0.0
                                          ? (coordinates(kept) == cell ? 0.0 : 2.0)
                                          : ((vertices_.row(kept) - vertices_.row(v)) / distance_).squaredNorm();
                if (square > least || (square == least && found != none_kept && kept > found)) continue;
                found = kept;
                least = square;
            }
        };
        if (distance_ == 0.0) {
            look(coordinates(v));
            return found;
        }
        const Cell low = cell_at(v, -distance_), high = cell_at(v, distance_);
        for (double x = low[0]; x <= high[0]; ++x)
            for (double y = low[1]; y <= high[1]; ++y)
                for (double z = low[2]; z <= high[2]; ++z) look({x, y, z});
        return found;
    }

    void keep(Index v)
    {
        Index& head = heads_[bucket(distance_ == 0.0 ? coordinates(v) : cell_at(v, 0.0))];
        next_[static_cast<std::size_t>(v)] = std::exchange(head, v);
    }

private:
    /// Compared by their bits, so that a NaN equals itself.
    struct Cell : std::array<double, 3> {
        friend bool operator==(const Cell& a, const Cell& b)
        {
            using Bits = std::array<std::uint64_t, 3>;
            return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
        }
    };

    Cell coordinates(Index v) const
    {
        return {vertices_(v, 0) + 0.0, vertices_(v, 1) + 0.0, vertices_(v, 2) + 0.0};  // -0 becomes 0
    }

    Cell cell_at(Index v, double offset) const
    {
        const auto cell = [&](int axis) { return std::floor((vertices_(v, axis) + offset) / side_) + 0.0; };
        return {cell(0), cell(1), cell(2)};
    }

    std::size_t bucket(const Cell& cell) const
    {
        std::uint64_t hash = 0;
        for (const double number : cell) {  // the finalizer of MurmurHash3
            hash ^= std::bit_cast<std::uint64_t>(number);
            hash = (hash ^ hash >> 33) * 0xFF51AFD7ED558CCDU;
            hash = (hash ^ hash >> 33) * 0xC4CEB9FE1A85EC53U;
        }
        return static_cast<std::size_t>(hash ^ hash >> 33) & (heads_.size() - 1);
    }

    const Vertices& vertices_;
    double distance_, side_ = 1.0;
    std::vector<Index> heads_, next_;  // of the chain of each bucket
};

/// Both ends of each edge that one triangle has, each edge once.
std::vector<std::array<Index, 2>> rim_edges(const Triangles& triangles, Eigen::Index vertex_count)
{
    const auto each_edge = [&](const auto& work) {
        for (Eigen::Index t = 0; t < triangles.rows(); ++t)
            for (int k = 0; k < 3; ++k) {
                const Index a = triangles(t, k), b = triangles(t, (k + 1) % 3);
                if (a != b) work(std::min(a, b), std::max(a, b));
            }
    };
    // The larger ends, by the smaller one.
    std::vector<std::size_t> begin(static_cast<std::size_t>(vertex_count) + 1, 0);
    each_edge([&](Index a, Index) { ++begin[static_cast<std::size_t>(a) + 1]; });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<Index> ends(begin.back());
    std::vector<std::size_t> place = begin;
    each_edge([&](Index a, Index b) { ends[place[a]++] = b; });
    std::vector<std::array<Index, 2>> edges;
    for (Index a = 0; a < static_cast<Index>(vertex_count); ++a) {
        const std::span own = std::span(ends).subspan(begin[a], place[a] - begin[a]);
        std::ranges::sort(own);
        for (std::size_t i = 0, next = 0; i < own.size(); i = next) {
            for (next = i + 1; next < own.size() && own[next] == own[i];) ++next;
            if (next == i + 1) edges.push_back({a, own[i]});
        }
    }
    return edges;
}

/// The number of sets that hold a corner of a triangle.
std::size_t component_count(DisjointSets& sets, const Triangles& triangles)
{
    std::vector<Index> roots;
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) roots.push_back(sets.find(triangles(t, 0)));
    sort_unique(roots);
    return roots.size();
}

/// A number with two digits that is not below this one.
std::string shown_distance(double number)
{
    const std::string text = formatted("%.1e", number);
    return std::strtod(text.c_str(), nullptr) < number ? formatted("%.1e", 1.05 * number) : text;
}

}  // namespace

std::vector<Index> weld(const Vertices& vertices, double distance)
{
    if (vertices.rows() == 0) return {};
    KeptVertices kept(vertices, distance);
    std::vector<Index> first(static_cast<std::size_t>(vertices.rows()));
    for (Index v = 0; v < static_cast<Index>(first.size()); ++v) {
        const Index nearest = kept.nearest(v);
        first[static_cast<std::size_t>(v)] = nearest == none_kept ? v : nearest;
        if (nearest == none_kept) kept.keep(v);
    }
    return first;
}

std::optional<Warning> coincident_vertices(const Vertices& vertices, const Triangles& triangles)
{
    // The vertices of rims, with the shortest edge of the rims at each.
    const std::vector<std::array<Index, 2>> edges = rim_edges(triangles, vertices.rows());
    std::vector<double> shortest(static_cast<std::size_t>(vertices.rows()), std::numeric_limits<double>::infinity());
    std::vector<Index> rim;
    for (const auto& [a, b] : edges) {
        const double length = (vertices.row(a) - vertices.row(b)).stableNorm();
        for (const Index v : {a, b}) {
            shortest[v] = std::min(shortest[v], length);
            rim.push_back(v);
        }
    }
    sort_unique(rim);
    if (rim.empty()) return {};
    std::vector<double> lengths = values_at(shortest, rim);
    std::ranges::nth_element(lengths, lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2));

    // Pairs that are close for the rims of both.
    constexpr double close = 0.01;  // of an edge
    const Vertices points = vertices(rim, Eigen::all);
    const std::vector<Index> first = weld(points, close * lengths[lengths.size() / 2]);
    std::vector<Index> found;  // in pairs
    double farthest = 0.0;
    for (std::size_t i = 0; i < rim.size(); ++i) {
        const Index v = rim[i], other = rim[static_cast<std::size_t>(first[i])];
        const double apart = (vertices.row(v) - vertices.row(other)).stableNorm();
        if (v == other || apart > close * std::min(shortest[v], shortest[other])) continue;
        farthest = std::max(farthest, apart);
        found.insert(found.end(), {v, other});
    }
    if (found.empty()) return {};

    // The components as they are, and with the pairs joined.
    DisjointSets sets(static_cast<std::size_t>(vertices.rows()));
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
        for (const int k : {1, 2}) sets.join(triangles(t, 0), triangles(t, k));
    const std::size_t before = component_count(sets, triangles);
    for (std::size_t i = 0; i < found.size(); i += 2) sets.join(found[i], found[i + 1]);
    const std::size_t after = component_count(sets, triangles);
    sort_unique(found);
    const std::string distance = farthest == 0.0 ? "0" : shown_distance(farthest);
    std::string sentence = counted(found.size(), "vertex") + " of rims lie " +
                           (farthest == 0.0 ? "at the place" : "within " + distance) +
                           " of another one: " + counted(before, "component");
    if (after < before) sentence += ", " + std::to_string(after) + " if they were joined";
    return Warning{WarningKind::coincident, sentence, found, "The option weld joins them in the UVs: weld " + distance};
}

}  // namespace koebe
