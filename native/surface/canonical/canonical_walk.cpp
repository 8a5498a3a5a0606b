#include "canonical/canonical_walk.h"

#include "canonical/canonical_position.h"
#include "core/connectivity.h"
#include "core/length.h"
#include "core/prefetch.h"
#include "execution/thread_share.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

namespace koebe {
namespace {

constexpr double hash_unit = 1e-3;  // unit of lengths in a hash, over the longest edge where a walk may start
constexpr int hash_rounds = 24;     // size of a hashed neighbourhood in edges

std::uint64_t mixed(std::uint64_t x)
{
    // The finalizer of SplitMix64 (Steele, Lea and Flood 2014).
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

std::uint64_t whole(double units) { return units < 0x1p62 ? static_cast<std::uint64_t>(std::llround(units)) : 0u; }

class StartFinder {
    using Key = std::pair<std::uint64_t, std::uint64_t>;

public:
    StartFinder(const JoinedFaces& faces, const Vertices& positions)
        : faces_(faces), positions_(positions), longest_(static_cast<std::size_t>(faces.patches), 0.0)
    {
    }

    std::vector<Index> run()
    {
        // Walks start at longest edges. Only ties need keys.
        std::vector<Index> candidates = longest_edges();
        if (faces_.patches == 1 && candidates.size() == 1) return candidates;
        const std::vector<Key> keys = keys_of(candidates);
        // How many candidates of a patch have the same key, and how many faces it has.
        std::map<std::pair<Index, Key>, Index> alike;
        for (std::size_t i = 0; i < keys.size(); ++i) ++alike[{patch_of(candidates[i]), keys[i]}];
        std::vector<Index> size(longest_.size(), 0);
        for (Index f = 0; f < static_cast<Index>(faces_.triangles.rows()); ++f)
            if (patch_of(3 * f) >= 0) ++size[patch_of(3 * f)];
        struct Start {
            Index halfedge = -1, faces = 0, alike = 0;
            Key key;
        };
        // Of each patch the key that is rarest, then greatest; the largest patch first.
        std::vector<Start> starts(longest_.size());
        for (std::size_t i = 0; i < keys.size(); ++i) {
            const Index p = patch_of(candidates[i]);
            const Start own{candidates[i], size[p], alike[{p, keys[i]}], keys[i]};
            if (starts[p].halfedge < 0 || std::tie(own.alike, starts[p].key) < std::tie(starts[p].alike, own.key))
                starts[p] = own;
        }
        std::ranges::stable_sort(starts, std::greater(),
                                 [](const Start& start) { return std::pair(start.faces, start.key); });
        std::vector<Index> result;
        for (const Start& start : starts) result.push_back(start.halfedge);
        return result;
    }

private:
    Index patch_of(Index h) const { return faces_.patch.empty() ? 0 : faces_.patch[face_of(h)]; }
    double length(Index h) const
    {
        return length_of(positions_.row(target(faces_.triangles, h)) - positions_.row(origin(faces_.triangles, h)));
    }

    std::vector<Index> longest_edges()
    {
        const auto halfedges = static_cast<Index>(faces_.twin.size());
        std::vector<char> has_rim(longest_.size(), 0);
        std::vector<Index> among =
            found_in_pieces(halfedges, [&](Index h) { return faces_.twin[h] == no_twin && patch_of(h) >= 0; });
        for (const Index h : among) has_rim[patch_of(h)] = 1;
        if (std::ranges::count(has_rim, 0) > 0)
            among = found_in_pieces(halfedges, [&](Index h) {
                return patch_of(h) >= 0 && (faces_.twin[h] == no_twin || !has_rim[patch_of(h)]);
            });
        for (const Index h : among) longest_[patch_of(h)] = std::max(longest_[patch_of(h)], length(h));
        std::erase_if(among, [&](Index h) { return length(h) < (1.0 - same_size) * longest_[patch_of(h)]; });
        return among;
    }

    /// The half-edges of all faces within so many edges from the ends of others.
    std::vector<Index> halfedges_around(const std::vector<Index>& starts, int edges) const
    {
        const std::vector<Index>& twin = faces_.twin;
        std::vector<bool> is_near(twin.size(), false), is_passed(twin.size(), false), is_found(twin.size() / 3, false);
        std::vector<Index> ring, next, result;  // a ring holds one half-edge from each of its fans
        const auto add = [&](Index h) {
            if (!is_near[h]) next.push_back(h);
            is_near[h] = true;
        };
        const auto find = [&](Index f) {
            if (is_found[f]) return;
            is_found[f] = true;
            for (Index h = 3 * f; h < 3 * f + 3; ++h) {
                result.push_back(h);
                add(h);
            }
        };
        for (const Index h : starts) {
            add(h);
            add(next_halfedge(h));
        }
        for (int step = 0; step <= edges && !next.empty(); ++step) {
            ring.swap(next);
            next.clear();
            for (const Index first : ring) {
                if (is_passed[first]) continue;
                const auto pass = [&](Index h) {
                    is_near[h] = is_passed[h] = true;
                    find(face_of(h));
                };
                Index h = first;
                for (; h != no_twin; h = twin[previous_halfedge(h)]) {
                    pass(h);
                    if (twin[previous_halfedge(h)] == first) break;
                }
                if (h != no_twin) continue;  // the walk went all round
                for (h = twin[first]; h != no_twin; h = twin[next_halfedge(h)]) pass(next_halfedge(h));
            }
        }
        return result;
    }

    /// (V) start values of vertices that have half-edges here: 1, or with several patches a distance from the middle.
    std::vector<std::uint64_t> first_hash(const std::vector<Index>& number, Index count) const
    {
        std::vector<std::uint64_t> hash(static_cast<std::size_t>(count), 1);
        if (faces_.patches == 1) return hash;
        Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
        double used = 0.0, reach = 0.0;
        const auto each = [&](const auto& visit) {
            for (Index h = 0; h < static_cast<Index>(faces_.twin.size()); ++h)
                if (patch_of(h) >= 0) visit(origin(faces_.triangles, h));
        };
        each([&](Index v) {
            middle += positions_.row(v);
            used += 1.0;
        });
        middle /= used;
        each([&](Index v) { reach = std::max(reach, length_of(positions_.row(v) - middle)); });
        for (Index v = 0; v < faces_.vertex_count; ++v)
            if (number[v] >= 0 && reach > 0.0)
                hash[number[v]] = whole(length_of(positions_.row(v) - middle) / (same_size * reach));
        return hash;
    }

    /// Numbers that distinguish the neighbourhoods of candidates, until all differ.
    std::vector<Key> keys_of(const std::vector<Index>& candidates) const
    {
        const Triangles& triangles = faces_.triangles;
        const std::vector<Index> around = halfedges_around(candidates, hash_rounds);
        struct Edge {
            Index from, to;  // local numbers of the vertices
            bool on_rim;
            std::uint64_t length;
        };
        std::vector<Index> number(faces_.vertex_count, -1);
        Index count = 0;
        for (const Index h : around)
            if (Index& own = number[origin(triangles, h)]; own < 0) own = count++;
        std::vector<Edge> edges;
        edges.reserve(around.size());
        for (const Index h : around) {
            const bool on_rim = faces_.twin[h] == no_twin;
            const double unit = longest_[patch_of(h)], units = unit > 0.0 ? length(h) / (hash_unit * unit) : 0.0;
            edges.push_back({number[origin(triangles, h)], number[target(triangles, h)], on_rim,
                             mixed(whole(units)) + (on_rim ? 1u : 0u)});
        }
        std::vector<std::uint64_t> hash = first_hash(number, count), next;
        for (int round = 0; round < hash_rounds; ++round) {
            next = hash;
            for (const Edge& e : edges) {
                next[e.from] += mixed(hash[e.to] ^ mixed(e.length));
                if (e.on_rim) next[e.to] += mixed(hash[e.from] ^ mixed(e.length + 1));
            }
            for (std::uint64_t& number_of_vertex : next) number_of_vertex = mixed(number_of_vertex);
            hash.swap(next);
            std::vector<Key> keys = keys_by(hash, number, candidates);
            std::sort(keys.begin(), keys.end());
            if (std::adjacent_find(keys.begin(), keys.end()) == keys.end()) break;
        }
        return keys_by(hash, number, candidates);
    }

    /// Keys from the two ends and the third corner of each candidate; two candidates may be one edge.
    std::vector<Key> keys_by(const std::vector<std::uint64_t>& hash, const std::vector<Index>& number,
                             const std::vector<Index>& candidates) const
    {
        const auto at = [&](Index h) { return hash[number[origin(faces_.triangles, h)]]; };
        std::vector<Key> keys;
        for (const Index h : candidates)
            keys.emplace_back(at(h), mixed(at(next_halfedge(h))) + at(previous_halfedge(h)));
        return keys;
    }

    const JoinedFaces& faces_;
    const Vertices& positions_;
    std::vector<double> longest_;  // of each patch: longest edge where its walk may start
};

}  // namespace

std::vector<Index> first_halfedges(const JoinedFaces& faces, const Vertices& positions)
{
    return StartFinder(faces, positions).run();
}

FaceWalk walk_from(const JoinedFaces& faces, const std::vector<Index>& starts)
{
    const Triangles& triangles = faces.triangles;
    FaceWalk walk;
    walk.entered.reserve(triangles.rows());
    walk.vertices.reserve(faces.vertex_count);
    std::vector<bool> is_met(triangles.rows(), false), is_numbered(faces.vertex_count, false);
    // A face is entered by the half-edge from its first vertex, so the walk depends on no number of the input.
    const auto meet = [&](Index h) {
        if (is_numbered[origin(triangles, h)]) return;
        is_numbered[origin(triangles, h)] = true;
        walk.vertices.push_back(origin(triangles, h));
    };
    const auto enter = [&](Index h) {
        is_met[face_of(h)] = true;
        walk.entered.push_back(h);
    };
    const auto cross = [&](Index h) {
        if (const Index twin = faces.twin[h]; twin != no_twin && !is_met[face_of(twin)]) enter(twin);
    };
    for (const Index start : starts) {
        std::size_t head = walk.entered.size();
        enter(start);
        meet(start);
        cross(start);
        meet(next_halfedge(start));
        // Breadth first: over the second and the third side of each face.
        for (; head < walk.entered.size(); ++head) {
            if (head + steps_ahead < walk.entered.size()) {
                const Index ahead = walk.entered[head + steps_ahead];
                prefetch(&faces.twin[ahead]);
                prefetch(&triangles.data()[ahead]);
            }
            const Index second = next_halfedge(walk.entered[head]), third = next_halfedge(second);
            cross(second);
            meet(third);
            cross(third);
        }
    }
    return walk;
}

}  // namespace koebe
