#include "pipeline/canonical_form.h"

#include "core/connectivity.h"
#include "core/errors.h"
#include "core/length.h"
#include "core/thread_share.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>

namespace koebe {
namespace {

constexpr double same = 1e-4;         // relative difference of lengths that count as one: more than 32-bit noise
constexpr double hash_unit = 1e-3;    // of lengths in a hash, over the longest boundary edge
constexpr int hash_rounds = 24;       // edges that a neighbourhood reaches
constexpr double coarsest = 0x1p-34;  // of the grid, over the extent
constexpr double finest = 0x1p-50;
constexpr double of_shortest = 0x1p-22;  // of the grid, over the shortest edge

std::uint64_t mixed(std::uint64_t x)
{
    // The finalizer of SplitMix64 (Steele, Lea and Flood 2014).
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

[[noreturn]] void throw_one_point() { throw InputError("all vertices lie on one point"); }

/// About 0 and of about unit size, so that no length overflows.
Vertices scaled(const Surface& surface, const Vertices& vertices)
{
    const Index any = surface.triangles(0, 0);
    Eigen::RowVector3d low = vertices.row(any), high = low;
    for (Eigen::Index i = 0; i < surface.triangles.size(); ++i) {
        low = low.cwiseMin(vertices.row(surface.triangles.data()[i]));
        high = high.cwiseMax(vertices.row(surface.triangles.data()[i]));
    }
    const Eigen::RowVector3d middle = 0.5 * low + 0.5 * high;
    const double extent = (0.5 * high - 0.5 * low).maxCoeff();
    if (!(extent > 0.0)) throw_one_point();
    return (vertices.rowwise() - middle) / extent;
}

/// The row that is farthest by a measure; of several about as far the first.
template <class Measure>
Eigen::Index farthest(const Vertices& points, const Measure& measure)
{
    Eigen::Index best = 0;
    double most = measure(0);
    for (Eigen::Index v = 1; v < points.rows(); ++v)
        if (const double m = measure(v); m > (1.0 + same) * most) {
            most = m;
            best = v;
        }
    return best;
}

CanonicalPosition position_of(const Triangles& triangles, Vertices points)
{
    points.rowwise() -= points.colwise().mean().eval();
    const Eigen::Vector3d reach = points.row(farthest(points, [&](Eigen::Index v) { return points.row(v).norm(); }));
    const double extent = points.rowwise().norm().maxCoeff();
    if (!(extent > 0.0)) throw_one_point();
    const Eigen::Vector3d first = reach / reach.norm();
    const auto aside = [&](Eigen::Index v) -> Eigen::Vector3d {
        const Eigen::Vector3d p = points.row(v);
        return p - p.dot(first) * first;
    };
    const Eigen::Vector3d sideways = aside(farthest(points, [&](Eigen::Index v) { return aside(v).norm(); }));
    // All on a line: any second axis will do.
    const Eigen::Vector3d second =
        sideways.norm() > same * extent ? Eigen::Vector3d(sideways / sideways.norm()) : first.unitOrthogonal();
    Eigen::Matrix3d frame;
    frame << first, second, first.cross(second);
    points = (points * frame / extent).eval();

    constexpr std::size_t at_a_time = 32768;
    constexpr double none = std::numeric_limits<double>::infinity();
    const std::size_t faces = static_cast<std::size_t>(triangles.rows());
    std::vector<std::pair<double, double>> least((faces + at_a_time - 1) / at_a_time);  // edge and height
    in_pieces(faces, at_a_time, [&](std::size_t begin, std::size_t end) {
        double shortest = none, thinnest = none;
        for (Eigen::Index f = static_cast<Eigen::Index>(begin); f < static_cast<Eigen::Index>(end); ++f) {
            const auto edge = [&](int k) -> Eigen::RowVector3d {
                return points.row(triangles(f, (k + 1) % 3)) - points.row(triangles(f, k));
            };
            const Eigen::RowVector3d first = edge(0), last = edge(2);
            double longest = 0.0;
            for (const double length : {first.norm(), edge(1).norm(), last.norm()}) {
                if (length > 0.0) shortest = std::min(shortest, length);
                longest = std::max(longest, length);
            }
            thinnest = std::min(thinnest, longest > 0.0 ? first.cross(last).norm() / longest : 0.0);
        }
        least[begin / at_a_time] = {shortest, thinnest};
    });
    double shortest = none, thinnest = none;
    for (const auto& [edge, height] : least) {
        shortest = std::min(shortest, edge);
        thinnest = std::min(thinnest, height);
    }
    const double grid = std::exp2(std::round(std::log2(std::clamp(of_shortest * shortest, finest, coarsest))));
    thinnest /= grid;
    points = (points.array() / grid).round() * grid;
    return {std::move(points), thinnest};
}

class Canonicalizer {
public:
    Canonicalizer(const Surface& surface, const Vertices& vertices)
        : surface_(surface), positions_(scaled(surface, vertices))
    {
    }

    CanonicalForm run()
    {
        number_from(first_halfedge());
        CanonicalPosition position =
            position_of(form_.surface.triangles, positions_(form_.original_vertices, Eigen::all));
        form_.vertices = std::move(position.vertices);
        form_.thinnest = position.thinnest;
        return std::move(form_);
    }

private:
    double length(Index h) const
    {
        return length_of(positions_.row(target(surface_.triangles, h)) - positions_.row(origin(surface_.triangles, h)));
    }

    Index first_halfedge() const
    {
        double longest = -1.0;
        for (Index h = 0; h < static_cast<Index>(surface_.twin.size()); ++h)
            if (surface_.twin[h] == no_twin) longest = std::max(longest, length(h));
        std::vector<Index> candidates;
        for (Index h = 0; h < static_cast<Index>(surface_.twin.size()); ++h)
            if (surface_.twin[h] == no_twin && length(h) >= (1.0 - same) * longest) candidates.push_back(h);
        if (candidates.size() == 1) return candidates.front();
        const std::vector<std::uint64_t> hash = neighbourhoods(candidates, longest);
        const auto key = [&](Index h) {
            return std::pair(hash[origin(surface_.triangles, h)], hash[target(surface_.triangles, h)]);
        };
        return *std::max_element(candidates.begin(), candidates.end(),
                                 [&](Index a, Index b) { return key(a) < key(b); });
    }

    /// The half-edges of all faces that a walk of so many edges from the ends of others comes to.
    std::vector<Index> halfedges_around(const std::vector<Index>& starts, int edges) const
    {
        const Triangles& triangles = surface_.triangles;
        std::vector<Index> begin(surface_.vertex_count + 1, 0), corner(triangles.size());
        for (Eigen::Index i = 0; i < triangles.size(); ++i) ++begin[triangles.data()[i] + 1];
        std::partial_sum(begin.begin(), begin.end(), begin.begin());
        std::vector<Index> end(begin.begin(), begin.end() - 1);
        for (Index h = 0; h < static_cast<Index>(triangles.size()); ++h) corner[end[triangles.data()[h]]++] = h;

        std::vector<char> is_near(surface_.vertex_count, 0), is_found(triangles.rows(), 0);
        std::vector<Index> ring, next, result;
        const auto add = [&](Index v) {
            if (!std::exchange(is_near[v], 1)) next.push_back(v);
        };
        for (const Index h : starts) {
            add(origin(triangles, h));
            add(target(triangles, h));
        }
        for (int step = 0; step <= edges && !next.empty(); ++step) {
            ring.swap(next);
            next.clear();
            for (const Index v : ring)
                for (Index i = begin[v]; i < end[v]; ++i) {
                    const Index f = face_of(corner[i]);
                    if (std::exchange(is_found[f], 1)) continue;
                    for (int k = 0; k < 3; ++k) {
                        result.push_back(3 * f + k);
                        add(triangles(f, k));
                    }
                }
        }
        return result;
    }

    /// A number for each vertex that tells its neighbourhood from others, until all candidates are told apart; of use
    /// at the candidates.
    std::vector<std::uint64_t> neighbourhoods(const std::vector<Index>& candidates, double unit) const
    {
        const Triangles& triangles = surface_.triangles;
        const std::vector<Index> around = halfedges_around(candidates, hash_rounds);
        std::vector<std::uint64_t> edge(around.size());
        for (std::size_t i = 0; i < around.size(); ++i) {
            const double units = unit > 0.0 ? length(around[i]) / (hash_unit * unit) : 0.0;
            edge[i] = mixed(units < 0x1p62 ? static_cast<std::uint64_t>(std::llround(units)) : 0u) +
                      (surface_.twin[around[i]] == no_twin ? 1u : 0u);
        }
        std::vector<Index> vertices;
        std::vector<char> is_listed(surface_.vertex_count, 0);
        for (const Index h : around)
            if (const Index v = origin(triangles, h); !std::exchange(is_listed[v], 1)) vertices.push_back(v);
        std::vector<std::uint64_t> hash(surface_.vertex_count, 1), next(surface_.vertex_count, 0);
        for (int round = 0; round < hash_rounds; ++round) {
            for (const Index v : vertices) next[v] = hash[v];
            for (std::size_t i = 0; i < around.size(); ++i) {
                const Index h = around[i], a = origin(triangles, h), b = target(triangles, h);
                next[a] += mixed(hash[b] ^ mixed(edge[i]));
                if (surface_.twin[h] == no_twin) next[b] += mixed(hash[a] ^ mixed(edge[i] + 1));
            }
            for (const Index v : vertices) next[v] = mixed(next[v]);
            hash.swap(next);
            std::vector<std::uint64_t> keys;
            for (const Index h : candidates)
                keys.push_back(mixed(hash[origin(triangles, h)]) + hash[target(triangles, h)]);
            std::sort(keys.begin(), keys.end());
            if (std::adjacent_find(keys.begin(), keys.end()) == keys.end()) break;
        }
        return hash;
    }

    /// Breadth first over the faces, each from the corner it is entered by.
    void number_from(Index start)
    {
        const Index face_count = static_cast<Index>(surface_.triangles.rows());
        Surface& surface = form_.surface;
        surface.triangles.resize(face_count, 3);
        surface.twin.assign(3 * static_cast<std::size_t>(face_count), no_twin);
        rank_.assign(surface_.vertex_count, -1);
        std::vector<Index> entered(face_count, no_twin), place(face_count, -1);
        std::vector<Index> queue{start};
        queue.reserve(face_count);
        form_.original_faces.reserve(face_count);
        place[face_of(start)] = 0;
        entered[face_of(start)] = start;
        for (std::size_t head = 0; head < queue.size(); ++head) {
            Index h = queue[head];
            form_.original_faces.push_back(face_of(h));
            form_.first_corners.push_back(static_cast<char>((3 - h % 3) % 3));
            for (int k = 0; k < 3; ++k, h = next_halfedge(h)) {
                const Index v = origin(surface_.triangles, h);
                if (rank_[v] < 0) {
                    rank_[v] = static_cast<Index>(form_.original_vertices.size());
                    form_.original_vertices.push_back(v);
                }
                surface.triangles(static_cast<Eigen::Index>(head), k) = rank_[v];
                const Index twin = surface_.twin[h];
                if (twin == no_twin) continue;
                const Index g = face_of(twin);
                if (place[g] < 0) {
                    place[g] = static_cast<Index>(queue.size());
                    entered[g] = twin;
                    queue.push_back(twin);
                }
                surface.twin[3 * head + k] = 3 * place[g] + (twin - entered[g] + 3) % 3;
            }
        }
        surface.vertex_count = static_cast<Index>(form_.original_vertices.size());
        surface.euler_characteristic = surface_.euler_characteristic;
        surface.genus = surface_.genus;
        surface.reoriented = surface_.reoriented;
        surface.unused = surface_.unused;
        for (VertexLoop loop : surface_.loops) {
            for (Index& v : loop) v = rank_[v];
            std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
            surface.loops.push_back(std::move(loop));
        }
        std::sort(surface.loops.begin(), surface.loops.end());
    }

    const Surface& surface_;
    Vertices positions_;
    std::vector<Index> rank_;
    CanonicalForm form_;
};

}  // namespace

CanonicalForm canonical_form(const Surface& surface, const Vertices& vertices)
{
    return Canonicalizer(surface, vertices).run();
}

CanonicalPosition canonical_position(const Surface& surface, const Vertices& vertices)
{
    return position_of(surface.triangles, scaled(surface, vertices));
}

}  // namespace koebe
